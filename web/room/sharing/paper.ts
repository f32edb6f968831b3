/**
 * Draws pages of a PDF by pdf.js, which the room's page loads when somebody shares one, and not before.
 *
 * A file of anybody's is read in a worker that is ended when it takes too long. Nothing in a file runs: no scripts, no forms,
 * no fonts compiled to code; and nothing is fetched for it.
 */

import { AnnotationMode, getDocument, PDFWorker, type PDFDocumentProxy } from "pdfjs-dist/legacy/build/pdf.mjs";

const MIB = 2 ** 20;
const MOST_BYTES = 64 * MIB;
const MOST_PAGES = 2000;
/** Of the longer side: a wall in a page has no more. */
const MOST_PIXELS = 1920;
/** Of one picture on a page; larger ones are left out. */
const MOST_PICTURE_PIXELS = 2 ** 25;
/** To read a file, or to draw a page: slides take a tenth of a second, a city's map takes three. */
const PATIENCE_MS = 20_000;

/** The reason why a PDF is not shown, as the end of a sentence. */
export class PaperError extends Error {
  override name = "PaperError";
}

export class Paper {
  private constructor(
    private readonly document: PDFDocumentProxy,
    private readonly worker: Worker,
  ) {}

  static async open(file: Blob): Promise<Paper> {
    if (file.size > MOST_BYTES) {
      throw new PaperError(`the PDF has ${Math.ceil(file.size / MIB)} MiB, and ${MOST_BYTES / MIB} are read; share fewer pages`);
    }
    const data = new Uint8Array(await file.arrayBuffer());
    if (!new TextDecoder("latin1").decode(data.subarray(0, 1024)).includes("%PDF-")) {
      throw new PaperError("the file is no PDF; its first bytes say so");
    }
    const worker = new Worker("/static/pdf.worker.js", { type: "module" });
    try {
      const reading = getDocument({
        data,
        worker: PDFWorker.create({ port: worker }),
        isEvalSupported: false,
        enableXfa: false,
        useWasm: false,
        useWorkerFetch: false,
        maxImageSize: MOST_PICTURE_PIXELS,
        verbosity: 0,
      });
      const read = await within(reading.promise, "the PDF takes too long to read; share the window that shows it");
      if (read.numPages > MOST_PAGES) {
        throw new PaperError(`the PDF has ${read.numPages} pages, and ${MOST_PAGES} are read; share fewer of them`);
      }
      return new Paper(read, worker);
    } catch (error) {
      worker.terminate();
      throw reason(error, "the PDF");
    }
  }

  get pages(): number {
    return this.document.numPages;
  }

  /** A page, counted from 1, on a canvas of its own: the page before is seen until this one is there. */
  async draw(number: number): Promise<HTMLCanvasElement> {
    try {
      const late = `page ${number} takes too long to draw; share the window that shows it`;
      const page = await within(this.document.getPage(number), late);
      const { width, height } = page.getViewport({ scale: 1 });
      const longer = Math.max(width, height);
      if (!(longer > 0 && Number.isFinite(longer))) throw new PaperError(`page ${number} has no size`);
      const viewport = page.getViewport({ scale: MOST_PIXELS / longer });
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [Math.max(2, Math.round(viewport.width)), Math.max(2, Math.round(viewport.height))];
      const drawing = page.render({ canvas, viewport, background: "white", annotationMode: AnnotationMode.DISABLE });
      try {
        await within(drawing.promise, late);
      } catch (error) {
        drawing.cancel();
        throw error;
      }
      page.cleanup();
      return canvas;
    } catch (error) {
      throw reason(error, `page ${number}`);
    }
  }

  close(): void {
    void this.document.loadingTask.destroy().catch(() => undefined);
    this.worker.terminate();
  }
}

async function within<T>(promise: Promise<T>, late: string): Promise<T> {
  let timer = 0;
  const patience = new Promise<never>((_, reject) => {
    timer = self.setTimeout(() => reject(new PaperError(late)), PATIENCE_MS);
  });
  try {
    return await Promise.race([promise, patience]);
  } finally {
    clearTimeout(timer);
  }
}

/** The library's complaint, for people. */
function reason(error: unknown, what: string): PaperError {
  if (error instanceof PaperError) return error;
  const { name } = error as Error;
  if (name === "PasswordException") return new PaperError("the PDF needs a password; save it without one");
  return new PaperError(`${what} cannot be read, as it is damaged; share the window that shows it`);
}
