/** Elements of the page that a script works on. */

/** The element of an id, which the page's HTML has. */
export function byId<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}
