/** Shows what calibration asks for: the face to make, how long, and how it went. */

import { byId } from "../elements.js";
import { words, type Settings, type Step } from "./messages.js";

/** A result stays as long where no other step comes; frames go on telling the last one. */
const TOLD_MS = 4000;

const STATES: Readonly<Record<Step["state"], string>> = {
  countdown: "Get ready",
  recording: "Hold it",
  done: "Done",
  again: "Once more",
  failed: "Not calibrated",
  cancelled: "Cancelled",
};

function runs(phase: string): boolean {
  return phase.endsWith("countdown") || phase.endsWith("recording");
}

export class CalibrationView {
  private readonly card = byId("asking");
  private readonly name = byId("asking-name");
  private readonly seconds = byId("asking-seconds");
  private readonly text = byId("asking-text");
  private readonly progress = byId<HTMLProgressElement>("asking-progress");
  private readonly cancel = byId<HTMLButtonElement>("asking-cancel");
  private readonly person = byId("person");
  private phase = "";
  private most = 1;
  private told = 0;
  /** Whether it can be ended: also between two faces, where none is asked for. */
  private underWay = false;
  /** Whether this page saw a face being asked for. */
  private saw = false;

  constructor(start: (step: string) => void, cancel: () => void) {
    byId<HTMLFormElement>("calibrate").addEventListener("submit", (event) => {
      event.preventDefault();
      start(byId<HTMLSelectElement>("step").value);
    });
    this.cancel.addEventListener("click", cancel);
    addEventListener("keydown", ({ key }) => {
      if (key === "Escape" && this.underWay) cancel();
    });
  }

  private get runs(): boolean {
    return runs(this.phase);
  }

  /** What can be asked for. */
  offer(steps: readonly string[]): void {
    const options = steps.map((step) => new Option(words(step), step));
    if (steps.length > 1) options.unshift(new Option("All faces", "all"));
    const select = byId<HTMLSelectElement>("step");
    const chosen = select.value;
    select.replaceChildren(...options);
    if (options.some(({ value }) => value === chosen)) select.value = chosen; // the line comes and goes
  }

  /** Whose face is known. */
  tell({ calibrated, profile }: Settings): void {
    if (calibrated === undefined) return;
    this.write(this.person, calibrated ? `as ${profile ?? "somebody"}` : "not calibrated yet");
  }

  show(step: Step | null, underWay?: boolean): void {
    this.underWay = underWay ?? (step !== null && runs(`${step.name} ${step.state}`));
    if (!step) {
      if (this.runs) this.card.hidden = true; // it was cut off
      this.phase = "";
      return;
    }
    const phase = `${step.name} ${step.state}`;
    if (phase === this.phase && this.card.hidden) return;
    this.saw ||= runs(phase);
    if (!this.saw) return; // how one went that was over before this page came
    if (phase !== this.phase) {
      this.phase = phase;
      this.most = Math.max(step.seconds_left, 0.1);
      clearTimeout(this.told);
      if (!this.runs) this.told = setTimeout(() => (this.card.hidden = true), TOLD_MS);
    }
    this.card.hidden = false;
    this.card.dataset["state"] = step.state;
    this.write(this.name, `${words(step.name)} · ${STATES[step.state]}`);
    this.write(this.text, step.text);
    this.write(this.seconds, this.runs ? `${Math.ceil(step.seconds_left)}` : "");
    this.progress.hidden = !this.runs;
    this.cancel.hidden = !this.underWay;
    this.progress.value = 1 - Math.min(step.seconds_left / this.most, 1);
  }

  /** Only what changed, or screen readers would read it again. */
  private write(element: HTMLElement, text: string): void {
    if (element.textContent !== text) element.textContent = text;
  }
}
