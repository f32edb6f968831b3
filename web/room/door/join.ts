/** The page before the room: name, avatar, microphone with its level, camera; and the link that it all comes from. */

import { byId } from "../../elements.js";
import type { About } from "../line/texts.js";
import { Microphone } from "../voice/microphone.js";

/** What is behind a link: the room's name, and the key that the server never sees in an address. */
export interface Link {
  readonly room: string;
  readonly key: string;
}

export interface Choice {
  readonly name: string;
  readonly avatar: string;
  /** One's own avatar, which is not checked yet. */
  readonly own: File | undefined;
  readonly microphone: Microphone | undefined;
  readonly camera: boolean;
  /** Whether the microphone hears what is played, in a browser that has to be helped with that (loopback.ts). */
  readonly echoes: boolean;
  readonly recorded: boolean;
  /** Id of the recording that was asked about. */
  readonly recording: string;
}

/** -60 dB is silence on the meter, 0 dB its end. */
const SILENT_DB = -60;

export function readLink(): Link | undefined {
  const room = /^\/room\/([a-z0-9][a-z0-9-]{0,39})$/.exec(location.pathname)?.[1];
  const key = /^#([A-Za-z0-9_-]{22})$/.exec(location.hash)?.[1];
  return room && key ? { room, key } : undefined;
}

/** What the room says to whoever is still outside; a server that says nothing is tried for by the line itself. */
export async function about({ room }: Link): Promise<About> {
  const answer = await fetch(`/room/${room}/about.json`, { cache: "no-store" }).catch(() => undefined);
  return answer?.ok ? ((await answer.json()) as About) : { recording: "", replay: false, engine: false };
}

/** Ask until the person presses "Come in". */
export async function ask(avatars: string[], { recording, replay, engine }: About): Promise<Choice> {
  const form = byId<HTMLFormElement>("join");
  const field = <T extends HTMLElement>(name: string): T => form.elements.namedItem(name) as T;
  const [name, avatar, voice] = [field<HTMLInputElement>("name"), field<HTMLSelectElement>("avatar"), field<HTMLInputElement>("voice")];
  const [devices, camera] = [field<HTMLSelectElement>("microphone"), field<HTMLInputElement>("camera")];
  const headphones = field<HTMLInputElement>("headphones");
  const consent = field<RadioNodeList & HTMLElement>("consent");
  byId("recording").hidden = !recording;
  byId("straight").hidden = engine;
  byId("passed").hidden = !engine;
  byId("replayed").hidden = !replay;
  for (const choice of document.querySelectorAll<HTMLInputElement>("#recording input")) choice.required = recording !== "";
  const word = byId("word");
  const level = byId<HTMLMeterElement>("level");
  avatar.replaceChildren(...avatars.map((each) => new Option(each)));
  name.value ||= localStorage.getItem("name") ?? ""; // a quick hand has typed already
  let microphone: Microphone | undefined;

  /** Which there are, and which one is in use. */
  const list = async (): Promise<void> => {
    const found = (await navigator.mediaDevices.enumerateDevices()).filter(({ kind }) => kind === "audioinput");
    devices.replaceChildren(...found.map(({ label, deviceId }) => new Option(label || "microphone", deviceId)));
    const used = microphone?.stream.getAudioTracks()[0]?.getSettings().deviceId;
    if (used) devices.value = used;
  };
  let newest = 0;
  const listen = async (): Promise<void> => {
    const choice = ++newest;
    microphone?.close();
    microphone = undefined;
    word.textContent = "";
    if (!voice.checked) return;
    try {
      const given = await Microphone.ask(devices.value || undefined);
      if (choice !== newest) return given.close(); // something else was chosen while the browser asked
      microphone = given;
      await list();
    } catch (error) {
      if (choice !== newest) return;
      voice.checked = false;
      word.textContent = sentence(error);
    }
  };
  let listening = listen();
  for (const each of [voice, devices]) each.addEventListener("change", () => (listening = listen()));
  const plugged = (): void => void (microphone?.gone ? (listening = listen()) : list());
  navigator.mediaDevices?.addEventListener("devicechange", plugged);
  const shown = setInterval(() => {
    const db = 20 * Math.log10(Math.max(microphone?.level ?? 0, 1e-6));
    level.value = Math.max(0, 1 - db / SILENT_DB);
  }, 50);
  const submitted = new Promise<void>((resolve) => {
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      resolve();
    });
  });
  await submitted;
  word.textContent ||= voice.checked ? "Answer the browser's question for the microphone, or untick Microphone." : "";
  // another one may be chosen meanwhile, or none: that answers for the one that the browser still asks about
  for (let last; last !== listening; ) await Promise.race([(last = listening), once([voice, devices], "change")]);
  clearInterval(shown);
  navigator.mediaDevices?.removeEventListener("devicechange", plugged);
  localStorage.setItem("name", name.value.trim());
  form.hidden = true;
  const echoes = !!microphone && !headphones.checked && "userAgentData" in navigator; // only Chromium has that
  const recorded = recording !== "" && consent.value === "yes";
  return { name: name.value.trim(), avatar: avatar.value, own: field<HTMLInputElement>("own").files?.[0], microphone, camera: camera.checked, echoes, recorded, recording };
}

function once(elements: readonly HTMLElement[], event: string): Promise<unknown> {
  return new Promise((resolve) => elements.forEach((each) => each.addEventListener(event, resolve, { once: true })));
}

/** Whether it was the operating system that refused, which Chromium's browsers say; a person can change it there alone. */
export function isOfSystem(error: unknown): boolean {
  return error instanceof DOMException && error.name === "NotAllowedError" && /by system/i.test(error.message);
}

/** What a browser's refusal of a device means; `then` is what to do once it is allowed. */
export function sentence(error: unknown, then = "tick again"): string {
  const name = error instanceof DOMException ? error.name : "";
  if (!isSecureContext) return "Browsers give devices to https pages alone; you can still listen and write.";
  if (isOfSystem(error)) return `The system keeps the device from the browser; allow it in the system's privacy settings, then ${then}.`;
  if (name === "NotAllowedError") return `The browser was told not to give the device; allow it beside the address, then ${then}.`;
  if (name === "NotFoundError") return "No such device was found; you can still listen and write.";
  return `The device cannot be used (${error instanceof Error ? error.message : error}).`;
}
