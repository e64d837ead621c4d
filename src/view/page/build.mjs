// Bundles the modules of this folder and three.js into one page without a scene: node build.mjs OUTPUT
import { build, transform } from 'esbuild';
import { readFile, writeFile } from 'node:fs/promises';

const here = new URL('.', import.meta.url);
const text = (name) => readFile(new URL(name, here), 'utf8');

const script = await build({
  entryPoints: [new URL('main.js', here).pathname],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2022',
  charset: 'ascii',
  legalComments: 'none', // the page contains the whole licence
});
const style = await transform(await text('style.css'), { loader: 'css', minify: true });
const licence = await text('node_modules/three/LICENSE');
const parts = {
  '/*style*/': style.code.trim(),
  '/*script*/': script.outputFiles[0].text.trim(),
  '<!--licence-->': `<!--\nThis page contains three.js:\n\n${licence.trim()}\n-->`,
};
let page = await text('page.html');
for (const [mark, part] of Object.entries(parts)) page = page.replace(mark, () => part);
await writeFile(process.argv[2], page);
