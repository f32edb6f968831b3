/** What did not come about by a network is tried again, for as long as somebody wants it. */

/** The first try may have fallen into a break of a second; a file that is missing for long is asked for seldom. */
const WAITS_MS = [2000, 5000, 15_000, 60_000, 300_000];

/** What `attempt` gives at last; undefined where it is wanted no longer. */
export async function again<T>(attempt: () => Promise<T | undefined>, wanted: () => boolean): Promise<T | undefined> {
  for (let tried = 0; wanted(); tried++) {
    const found = await attempt();
    if (found !== undefined) return found;
    const wait = WAITS_MS[Math.min(tried, WAITS_MS.length - 1)]!;
    await new Promise((resolve) => setTimeout(resolve, wait * (1 + Math.random() / 2))); // pages do not come all at once
  }
  return undefined;
}
