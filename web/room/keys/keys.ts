/** Which keys are the meeting's. */

/** What takes keys for itself: fields, and lists that keys scroll. */
const TAKES = "input, textarea, select, #lines, #people";

/** Whether a key that was pressed is meant for the meeting, not for what has the focus, nor for the browser. */
export function isMeant({ target, ctrlKey, metaKey, altKey }: KeyboardEvent): boolean {
  if (ctrlKey || metaKey || altKey) return false;
  return !(target instanceof HTMLElement) || target.closest(TAKES) === null;
}
