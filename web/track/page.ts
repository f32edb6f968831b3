/** The page of track: an avatar, the cameras' pictures, weights and controls, of one session on this machine. */

import { SHAPES, type Face } from "../avatar/index.js";
import { byId } from "../elements.js";
import { CalibrationView } from "./calibration.js";
import { Cameras } from "./camera.js";
import { Connection, type State } from "./connection.js";
import { Held } from "./held.js";
import type { Frame, Hello } from "./messages.js";
import { Recorder } from "./recorder.js";
import { Stage } from "./stage.js";
import { Weights } from "./weights.js";

/** A sentence about something that was asked for stays for so long. */
const SAID_MS = 9000;
/** The measures are read, not watched. */
const MEASURES_MS = 500;

const SHARED = "Your pictures go to whoever has this page's link, without encryption, and to nobody else.";

let saying = 0;
function say(sentence: string): void {
  const place = byId("said");
  place.textContent = sentence;
  place.hidden = !sentence;
  clearTimeout(saying);
  saying = setTimeout(() => (place.hidden = true), SAID_MS);
}

/** A button that is on or off; `set` shows what the session says. */
class Switch {
  private readonly button: HTMLButtonElement;
  private readonly held = new Held();

  constructor(
    id: string,
    private readonly changed: (on: boolean) => void,
  ) {
    this.button = byId<HTMLButtonElement>(id);
    this.button.addEventListener("click", () => {
      this.held.hold();
      this.button.ariaPressed = `${!this.on}`;
      this.changed(this.on);
    });
  }

  get on(): boolean {
    return this.button.ariaPressed === "true";
  }

  set(on: boolean): void {
    if (!this.held.on && on !== this.on) this.button.ariaPressed = `${on}`;
  }
}

/** A frame's face, in the order of `SHAPES`. */
function faceOf({ weights, gaze, head }: Frame, order: readonly number[]): Face | undefined {
  if (!weights) return undefined;
  const whole = (values: readonly (number | null)[] | null): number[] | undefined =>
    values?.every((value) => value !== null) ? (values as number[]) : undefined;
  return {
    weights: Float32Array.from(order, (place) => weights[place] ?? NaN),
    gaze: whole(gaze) as Face["gaze"],
    head: whole(head)?.slice(3) as unknown as Face["head"],
  };
}

let order: readonly number[] = SHAPES.map((_, index) => index);
let face: Face | undefined;
let measuredAt = 0;
/** Number of the last sentence that was shown; none behind a greeting, as what was said before it is of no use now. */
let heard: number | undefined;

const stage = new Stage(say);
const weights = new Weights(byId("regions"), (shape, value) => connection.send({ verb: "gain", shape, value }));
const cameras = new Cameras(byId("cameras"));
const recorder = new Recorder((value) => connection.send({ verb: "record", value }), say);
const calibration = new CalibrationView(
  (value) => connection.send({ verb: "calibrate", value }),
  () => connection.send({ verb: "cancel" }),
);
const mirror = new Switch("mirror", (value) => connection.send({ verb: "mirror", value }));
const picture = new Switch("picture", (value) => {
  connection.send({ verb: "picture", value });
  byId<HTMLButtonElement>("points").disabled = !value;
  if (!value) cameras.clear();
});
new Switch("points", (value) => (cameras.points = value));
new Switch("gains", (value) => {
  byId("weights").classList.toggle("gaining", value);
  byId("gains-reset").hidden = !value;
});
byId("recentre").addEventListener("click", () => connection.send({ verb: "recentre" }));
byId("gains-reset").addEventListener("click", () => weights.resetGains());

function showState(state: State, sentence: string): void {
  const place = byId("connection");
  if (place.dataset["state"] === state && place.textContent === sentence) return;
  place.dataset["state"] = state;
  place.textContent = sentence;
}

function showFaults(faults: readonly string[]): void {
  const place = byId("faults");
  if (faults.join("\n") === [...place.children].map((each) => each.textContent).join("\n")) return;
  place.replaceChildren(
    ...faults.map((fault) => {
      const item = document.createElement("li");
      item.textContent = fault;
      return item;
    }),
  );
}

/** What came of what was asked for: the terminal, which has it too, is seldom in sight. */
function showSaid(said: Required<Frame>["said"]): void {
  const fresh = said.filter(([number]) => heard !== undefined && number > heard);
  if (fresh.length) say(fresh.map(([, text]) => text.charAt(0).toUpperCase() + text.slice(1)).join(". "));
  heard = Math.max(heard ?? 0, ...said.map(([number]) => number));
}

function showMeasures({ fps, latency }: Frame): void {
  const now = performance.now();
  if (now - measuredAt < MEASURES_MS) return;
  measuredAt = now;
  const ms = (value: number | null | undefined): string => (value == null ? "–" : `${Math.round(value)} ms`);
  byId("fps").textContent = fps == null ? "–" : fps.toFixed(fps < 9.95 ? 1 : 0);
  byId("delay").textContent = ms(latency.p50);
  byId("slowest").textContent = ms(latency.p95);
}

const connection: Connection = new Connection({
  state(state, sentence) {
    showState(state, sentence);
    if (state !== "lost") return;
    showFaults([]);
    calibration.show(null);
  },
  hello(hello: Hello) {
    heard = undefined;
    order = SHAPES.map((shape) => hello.shapes.indexOf(shape));
    cameras.name(hello.cameras);
    calibration.offer(hello.steps);
    if (hello.shared) byId("stays").textContent = SHARED;
    connection.send({ verb: "picture", value: picture.on });
  },
  frame(news) {
    face = faceOf(news, order);
    if (face) recorder.add(face);
    cameras.expect(news.cameras);
    calibration.show(news.step, news.settings.calibrating);
    showFaults(news.faults);
    showSaid(news.said ?? []);
    showMeasures(news);
    const { settings } = news;
    recorder.follow(settings.recording);
    calibration.tell(settings);
    if (settings.mirror !== undefined) {
      mirror.set(settings.mirror);
      cameras.mirror(settings.mirror);
    }
    if (settings.gains) weights.showGains(settings.gains);
    restIfHidden();
  },
  picture: (camera, jpeg) => void (picture.on && cameras.show(camera, jpeg)),
  refused: say,
});

/** A page that nobody sees costs nothing, unless it records: browsers stop to draw it by themselves. */
function restIfHidden(): void {
  if (document.hidden && !recorder.recording) connection.rest();
}

document.addEventListener("visibilitychange", () => {
  restIfHidden();
  if (!document.hidden) connection.goOn();
});

function draw(): void {
  requestAnimationFrame(draw);
  const shown = recorder.played() ?? face;
  face = undefined;
  if (shown) weights.show(shown.weights);
  stage.draw(shown);
}

void stage.wearOurs();
draw();
/** For whoever looks with the browser's console, and for tests. */
Object.assign(globalThis, { track: { stage } });
