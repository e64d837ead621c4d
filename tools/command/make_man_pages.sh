#!/usr/bin/env bash
# Writes a manual page of the command and of each subcommand into a folder: tufted.1, tufted-laplacian.1, ...
#   make_man_pages.sh COMMAND FOLDER    needs help2man
set -euo pipefail

command=$1 folder=$2
mkdir -p "$folder"
words=$("$command" --help | sed -n '/^Options:/,/^$/d; /^Examples:/q; s/^  \([a-z-]\{1,\}\) .*/\1/p')

# page NAME SECTION_NAME HELP: makes a page from a help text by help2man.
page() {
  help2man --no-info --no-discard-stderr --name "$2" --help-option "$3" --version-string "$version" \
    --output "$folder/$1.1" "$command"
  sed -i "s/^tufted \\\\- /$1 \\\\- /" "$folder/$1.1"  # help2man puts the program's name where the page's belongs
}

version=$("$command" --version | head -n 1)
page tufted "a Laplacian for point clouds and triangle meshes" --help
for word in $words; do
  page "tufted-$word" "$("$command" help "$word" | head -n 1 | sed 's/\.$//')" "help $word"
done
