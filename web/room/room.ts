/** The page of a room: asks who comes, and opens the meeting. */

import { byId } from "../elements.js";
import { about, ask, readLink } from "./door/join.js";
import { randomText, secretOf } from "./door/secret.js";
import { Meeting } from "./meeting.js";
import { Wardrobe } from "./people/avatars.js";
import { Place } from "./scene/place.js";

/** Whether there is WebGL 2, which the picture is drawn with. */
function drawsPictures(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext(); // browsers hold few
  return context !== null;
}

/** Say why nobody comes in, also where the form has gone already. */
function refuse(text: string): void {
  byId("meeting").hidden = true;
  byId("join").hidden = false;
  byId("word").textContent = text;
  byId("join").querySelector("button")!.disabled = true;
}

async function main(): Promise<void> {
  addEventListener("hashchange", () => location.reload()); // another link was put into the same tab
  const link = readLink();
  if (!link) return refuse("This link is not whole: it ends with # and 22 characters. Ask for it again.");
  if (!drawsPictures()) {
    return refuse(
      "This browser draws no 3D pictures (WebGL). Switch on hardware acceleration in its settings, or take another browser; then load the page again.",
    );
  }
  const place = Place.load(link.room); // while the person fills in the form
  const choice = await ask(await Wardrobe.names(), await about(link));
  const secret = await secretOf(link);
  const visit = randomText(9);
  const { protocol, host, origin } = location;
  const meeting = new Meeting(
    `${protocol === "https:" ? "wss" : "ws"}://${host}/room/${link.room}/socket`,
    { kind: "join", version: 1, key: link.key, secret, name: choice.name, avatar: choice.avatar, visit, role: "page", recorded: choice.recorded, recording: choice.recording },
    choice.microphone,
    `${origin}/room/${link.room}#${link.key}.${secret}`,
    choice.echoes,
    await place,
  );
  if (choice.own) void meeting.brought.wear(choice.own);
  if (choice.camera) await meeting.watch();
  Object.assign(globalThis, { meeting }); // for tests, and for who looks into the page
}

void main().catch((error: unknown) => {
  console.error(error);
  refuse(`The page could not begin (${error instanceof Error ? error.message : error}); allow it to keep data (cookies), and load it again.`);
});
