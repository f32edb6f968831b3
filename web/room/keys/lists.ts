/** Lists of things to do: each does something as soon as it is chosen. */

/** Keys by which a closed list chooses on most systems: whoever looks what there is would do it. */
const CHOOSES = /^(Arrow(Up|Down|Left|Right)|Home|End|PageUp|PageDown|.)$/u;

/** Let a list open on keys by which it would choose while it is closed. Browsers without `:open` leave it as it is. */
export function openByKeys(list: HTMLSelectElement): void {
  if (!CSS.supports("selector(:open)")) return;
  list.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !CHOOSES.test(event.key) || list.matches(":open")) return;
    event.preventDefault();
    list.showPicker();
  });
}
