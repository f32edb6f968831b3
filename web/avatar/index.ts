/** Avatars in the browser: load a .glb or .vrm, drive it by the 52 ARKit weights, gaze and head; shared by track and room. */

export { Avatar, release } from "./avatar.js";
export { findBone, type BoneName } from "./bones.js";
export { rotation, type Face } from "./face.js";
export { AvatarError, fetchAvatar, loadAvatar, openAvatar } from "./load.js";
export { frameOf, Portrait, portraitLights } from "./portrait.js";
export { SHAPE_INDEX, SHAPES, shapeIndex } from "./shapes.js";
