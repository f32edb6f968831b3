/** What a moderator did to the person at this page, in a sentence: others see it in the list, and they would not know. */

import type { Person } from "../line/texts.js";

/** `shares` and `wears`: whether they share, and wear an avatar of their own, as far as this page wants it. */
export function newsOf(before: Person, after: Person, wants: { shares: boolean; wears: boolean }): string {
  if (after.muted && !before.muted) return "A moderator has muted you; nobody hears you.";
  if (before.muted && !after.muted) return "You may speak again.";
  if (before.own && !after.own && wants.wears) return "A moderator has taken your avatar off; you wear the room's.";
  if (before.shares && !after.shares && wants.shares) return "A moderator has ended your sharing.";
  if (before.name !== after.name) return `A moderator has this name: the others see you as ${after.name}.`;
  return "";
}
