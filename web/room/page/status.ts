/** The line below the picture: the newest notice for a while, else what camera and voices have to say. */

/** Who looks elsewhere, as at a slide, still finds it; what is so for longer is no notice. */
export const NOTICE_MS = 15_000;

export class Status {
  private notice = "";
  private until = -Infinity;
  private over = false;

  /** `line` shows it; `words` say what a person should know for as long as it is so, what matters most first. */
  constructor(
    private readonly line: Pick<Node, "textContent">,
    private readonly words: () => readonly string[],
  ) {}

  /** Say something for a while; an empty text takes back what was said. */
  tell(text: string, now: number, keep_ms = NOTICE_MS): void {
    if (this.over) return;
    [this.notice, this.until] = [text, now + keep_ms];
    this.show(now);
  }

  /** Say something that stays until something else is said. */
  hold(text: string, now: number): void {
    this.tell(text, now, Infinity);
  }

  /** Say the last word of a meeting. */
  end(text: string, now: number): void {
    this.hold(text, now);
    this.over = true;
  }

  /** Show what there is to say now. */
  show(now: number): void {
    const notice = now < this.until ? this.notice : "";
    const text = notice || this.words().find(Boolean) || "";
    if (this.line.textContent !== text) this.line.textContent = text; // a reader of screens says each change aloud
  }
}
