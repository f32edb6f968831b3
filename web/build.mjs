// Bundles what browsers get, beside the Python that serves it: `node build.mjs [--out FOLDER]`.
//
// With --out, all goes below FOLDER instead of the repository: a test compares the two. The same sources and the versions
// of package-lock.json give the same bytes.

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

import { build } from "esbuild";

const HERE = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({ options: { out: { type: "string" } } });
const ROOT = values.out ?? dirname(HERE);

/** By folder of the repository: what is bundled for it. */
const PAGES = {
  "track/page/static": ["track/page.ts", "track/page.css", "track/index.html"],
  "room/server/static": [
    "room/room.ts",
    "room/face/face.worker.ts",
    "room/sharing/paper.ts",
    "room/voice/frames.worklet.js",
    "room/room.css",
    "room/room.html",
  ],
};

/** Files that are served as they are, and where they come from. */
const COPIES = {
  "room/server/static/pdf.worker.js": "web/node_modules/pdfjs-dist/legacy/build/pdf.worker.min.mjs",
  "room/server/static/fvad.wasm": "web/node_modules/@echogarden/fvad-wasm/fvad.wasm",
};

/** Licences of the packages that a bundle holds, each whole, in the order of their names. */
async function licences(inputs) {
  const packages = new Set();
  for (const input of inputs) {
    const found = /^.*node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) packages.add(found[0]);
  }
  const texts = [...packages].sort().map(async (folder) => {
    const { name, version, license } = JSON.parse(await readFile(join(HERE, folder, "package.json"), "utf8"));
    // MediaPipe's package names its licence and has no copy of it; it is our own
    const own = license === "Apache-2.0" ? join(dirname(HERE), "LICENSE") : undefined;
    const text = await readFile(join(HERE, folder, "LICENSE"), "utf8").catch((error) => {
      if (own) return readFile(own, "utf8");
      throw error;
    });
    return `${name} ${version} (${license})\n\n${text.trim()}\n`;
  });
  return (await Promise.all(texts)).join(`\n${"-".repeat(80)}\n\n`);
}

/** Write files whole, and say how large they are. */
async function write(files) {
  for (const [path, contents] of files) {
    await mkdir(dirname(path), { recursive: true });
    await writeFile(path, contents);
    console.log(`${relative(ROOT, path)}  ${Math.ceil(contents.length / 1000)} kB`);
  }
}

for (const [folder, sources] of Object.entries(PAGES)) {
  const { outputFiles, metafile } = await build({
    absWorkingDir: HERE,
    entryPoints: sources,
    outdir: join(ROOT, folder),
    entryNames: "[name]",
    bundle: true,
    minify: true,
    format: "esm",
    target: ["chrome120", "firefox121", "safari17.5"],
    legalComments: "none", // LICENSES.txt has them whole
    loader: { ".html": "copy" },
    external: ["module"], // of Node, which a WebAssembly loader asks for there alone
    metafile: true,
    write: false,
    logLevel: "warning",
  });
  const files = outputFiles.map(({ path, contents }) => [path, contents]);
  files.push([join(ROOT, folder, "LICENSES.txt"), await licences(Object.keys(metafile.inputs))]);
  await write(files);
}

for (const [path, source] of Object.entries(COPIES)) {
  await write([[join(ROOT, path), await readFile(join(dirname(HERE), source))]]);
}
