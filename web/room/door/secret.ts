/** The secret by which a room knows the person of a tab again, and other random texts. */

import type { Link } from "./join.js";

/** A tab that is loaded again has its secret free by then. */
const FREE_MS = 500;

/** So many random bytes as base64url; a multiple of three. */
export function randomText(bytes: number): string {
  const text = btoa(String.fromCharCode(...crypto.getRandomValues(new Uint8Array(bytes))));
  return text.replaceAll("+", "-").replaceAll("/", "_");
}

/** This person's secret in this room: one for each tab, so that two tabs are two people, and the same after a reload. */
export async function secretOf({ room }: Link): Promise<string> {
  const place = `secret of ${room}`;
  const before = sessionStorage.getItem(place);
  if (before && (await take(before))) return before;
  const secret = randomText(18);
  sessionStorage.setItem(place, secret);
  await take(secret);
  return secret;
}

/** Take a secret for as long as this page is there; false where another tab has it, of which this one is a copy. */
function take(secret: string): Promise<boolean> {
  if (!navigator.locks) return Promise.resolve(true); // of a page without https
  return new Promise((resolve) => {
    const held = (): Promise<never> => {
      resolve(true);
      return new Promise(() => undefined);
    };
    navigator.locks.request(`room ${secret}`, { signal: AbortSignal.timeout(FREE_MS) }, held).catch(() => resolve(false));
  });
}
