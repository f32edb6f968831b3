// Packs what the room's server gives to browsers as small as Brotli can, once: `node pack.mjs`.
//
// Each file's packed form is called by the SHA-256 of its content, so that one of another version is never taken for it.
// The server sends these where it finds them, and packs with gzip where it does not. Python has no Brotli of its own.

import { createHash } from "node:crypto";
import { mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { brotliCompress, constants } from "node:zlib";

const SERVER = join(dirname(dirname(fileURLToPath(import.meta.url))), "room", "server");
const PACKED = join(SERVER, "packed");
/** Below this the page's files gain nothing that counts. */
const WORTH_BYTES = 100_000;

const compress = promisify(brotliCompress);
const digest = (content) => createHash("sha256").update(content).digest("hex");
const options = (length) => ({
  params: {
    [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY,
    [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS,
    [constants.BROTLI_PARAM_SIZE_HINT]: length,
  },
});

await mkdir(PACKED, { recursive: true });
const there = new Set(await readdir(PACKED));
const wanted = new Set();
for (const entry of await readdir(join(SERVER, "static"), { recursive: true, withFileTypes: true })) {
  if (!entry.isFile()) continue;
  const content = await readFile(join(entry.parentPath, entry.name));
  if (content.length < WORTH_BYTES) continue;
  const name = `${digest(content)}.br`;
  wanted.add(name);
  if (there.has(name)) continue;
  const packed = await compress(content, options(content.length));
  await writeFile(join(PACKED, name), packed);
  console.log(`${entry.name}  ${Math.ceil(content.length / 1000)} kB, packed ${Math.ceil(packed.length / 1000)} kB`);
}
for (const name of there) if (!wanted.has(name)) await rm(join(PACKED, name));
