// Builds template.html from src/: one page with its style and script inside, to be filled with data by the program.
import { createHash } from 'node:crypto';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = fileURLToPath(new URL('.', import.meta.url));
const out = process.argv[2] ?? `${here}template.html`;

const { outputFiles } = await build({
  absWorkingDir: here,
  entryPoints: ['src/main.js'],
  bundle: true,
  minify: true,
  write: false,
  outdir: 'out',
  format: 'iife',
  target: 'es2021',
  charset: 'utf8',
  legalComments: 'inline',
  logLevel: 'warning',
});
const text = (ending) => outputFiles.find(({ path }) => path.endsWith(ending)).text.trim();

// What check.sh knows the sources by.
const sum = createHash('sha256');
for (const name of ['build.mjs', 'package-lock.json', ...(await readdir(`${here}src`)).sort().map((file) => `src/${file}`)])
  sum.update(await readFile(here + name));

const page = (await readFile(`${here}src/index.html`, 'utf8'))
  .replace('SEAM_SOURCES', sum.digest('hex'))
  .replace('SEAM_STYLE', () => text('.css'))
  .replace('SEAM_SCRIPT', () => text('.js'));
await writeFile(out, page);
