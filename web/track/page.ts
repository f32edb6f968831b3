// The page of track: what it shows, by the messages of track/page.
import { Portrait } from "../avatar/index.js";

new Portrait(document.querySelector("canvas")!).draw(0);
