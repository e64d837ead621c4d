# Completion for bash of the command tufted: subcommands, options, named values of options, and files.
# All of them are taken from the help of the installed command.
_tufted() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} help
  COMPREPLY=()
  if ((COMP_CWORD == 1)) || [[ $COMP_CWORD == 2 && $before == help ]]; then
    help=$("${COMP_WORDS[0]}" --help 2>/dev/null | sed -n '/^Options:/,/^$/d; /^Examples:/q; s/^  \([a-z-]\{1,\}\) .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$help help --help --version" -- "$word")
    return
  fi
  help=$("${COMP_WORDS[0]}" help "${COMP_WORDS[1]}" 2>/dev/null) || return
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE '^  [-a-zA-Z,]*--[a-z-]+' <<<"$help" | grep -oE -- '--[a-z-]+')" -- "$word")
  elif [[ $before == --* ]]; then
    # The help lists named values of an option in its line: --preset clean|lidar|scan
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE -- "^  [-a-zA-Z,]*$before [a-z|-]+\|[a-z|-]+" <<<"$help" | sed 's/.* //; s/|/ /g')" -- "$word")
  fi
}
complete -o bashdefault -o default -F _tufted tufted
