/** Where people may stand, walk and sit in a place: read from the names of its nodes. */

/** A node of a place's file, as glTF has it: metres, y up. */
export interface NamedNode {
  readonly name: string;
  readonly x: number;
  readonly z: number;
  /** About y in radians; 0 looks along z. */
  readonly heading: number;
  /** Along its own x and z. */
  readonly scale: readonly [number, number];
}

export interface Spot {
  readonly x: number;
  readonly z: number;
  readonly heading: number;
}

/** What nobody walks through: half its size along its own axes. */
interface Block extends Spot {
  readonly half: readonly [number, number];
}

export type Point = readonly [x: number, z: number];

/** A body's half width: this far people keep from walls, tables, and twice as far from each other. */
const BODY = 0.35;
/** Who sits down is not farther from the seat than this. */
const REACH = 1.5;
/** Where no place is left, people stand on a grid of this width. */
const GRID = 0.8;
/** Metres that are none: less than a body shakes. */
const SAME = 1e-6;
/** Of a place without `walk`: half its sides. */
const ROOMY = 4;

export class Layout {
  private readonly places: readonly Spot[];
  private readonly seats: readonly Spot[];
  private readonly blocks: readonly Block[];
  private readonly walk: Block;

  /** Nodes that are named otherwise are let alone. */
  constructor(nodes: readonly NamedNode[]) {
    const named = (word: string): NamedNode[] =>
      nodes.filter(({ name }) => name === word || name.startsWith(`${word}.`)).sort((a, b) => (a.name < b.name ? -1 : 1));
    const block = ({ x, z, heading, scale }: NamedNode): Block => ({ x, z, heading, half: [Math.abs(scale[0]), Math.abs(scale[1])] });
    this.places = named("place");
    this.seats = named("seat");
    this.blocks = named("block").map(block);
    this.walk = named("walk").map(block)[0] ?? { x: 0, z: 0, heading: 0, half: [ROOMY, ROOMY] };
  }

  /**
   * Where a newcomer stands: the first place that is free, in the order of their names; then wherever there is room.
   *
   * Who looks at a replay (`aside`) leaves the places to the people of the recording.
   */
  freePlace(taken: readonly Point[], aside = false): Spot {
    const free = ({ x, z }: Spot, others: readonly Point[]): boolean => others.every(([ox, oz]) => Math.hypot(x - ox, z - oz) >= 2 * BODY);
    const kept = this.places.map(({ x, z }): Point => [x, z]);
    const place = aside ? undefined : this.places.find((spot) => free(spot, taken));
    const [middleX, middleZ] = middle(kept);
    return place ?? this.grid().find((spot) => free(spot, [...taken, ...kept])) ?? this.grid().find((spot) => free(spot, taken)) ?? this.places[0] ?? { x: middleX, z: middleZ, heading: 0 };
  }

  /** The nearest seat within reach on which nobody sits. */
  freeSeat(x: number, z: number, taken: readonly Point[]): Spot | undefined {
    const far = (spot: Spot): number => Math.hypot(spot.x - x, spot.z - z);
    return this.seats
      .filter((seat) => far(seat) <= REACH && taken.every(([ox, oz]) => Math.hypot(seat.x - ox, seat.z - oz) >= BODY))
      .sort((a, b) => far(a) - far(b))[0];
  }

  /** The nearest point where a body may stand. */
  allowed(x: number, z: number): [number, number] {
    // out of one block may be into the next: as often as there are blocks in a corner
    for (let round = 0; round < 4 && !this.stands(x, z); round++) {
      for (const block of this.blocks) [x, z] = outOf(block, x, z);
      [x, z] = into(this.walk, x, z);
    }
    return this.stands(x, z) ? [x, z] : this.beside(x, z);
  }

  private stands(x: number, z: number): boolean {
    return [into(this.walk, x, z), ...this.blocks.map((block) => outOf(block, x, z))].every(([nearX, nearZ]) => Math.hypot(nearX - x, nearZ - z) < SAME);
  }

  /** Between a block and a wall too near for a body: the nearest point along any block where one may stand. */
  private beside(x: number, z: number): [number, number] {
    const far = ([px, pz]: Point): number => Math.hypot(px - x, pz - z);
    const around = this.blocks.flatMap((block): [number, number][] => {
      const [u, v] = inwards(block, x, z);
      const [halfU, halfV] = [block.half[0] + BODY, block.half[1] + BODY];
      return [-1, 1].flatMap((side) => [outwards(block, side * halfU, v), outwards(block, u, side * halfV)]);
    });
    return around.filter(([px, pz]) => this.stands(px, pz)).sort((a, b) => far(a) - far(b))[0] ?? [x, z];
  }

  /** Points of the floor that are free of blocks, those near the places first, looking at their middle. */
  private grid(): Spot[] {
    const [middleX, middleZ] = middle(this.places.map(({ x, z }) => [x, z]));
    const spots: Spot[] = [];
    const [halfX, halfZ] = this.walk.half;
    for (let u = BODY - halfX; u <= halfX - BODY; u += GRID) {
      for (let v = BODY - halfZ; v <= halfZ - BODY; v += GRID) {
        const [x, z] = outwards(this.walk, u, v);
        const [nearX, nearZ] = this.allowed(x, z);
        if (Math.hypot(nearX - x, nearZ - z) < 1e-9) spots.push({ x, z, heading: Math.atan2(middleX - x, middleZ - z) });
      }
    }
    const far = ({ x, z }: Spot): number => Math.hypot(x - middleX, z - middleZ);
    return spots.sort((a, b) => far(a) - far(b));
  }
}

function middle(points: readonly Point[]): Point {
  const sum = points.reduce<Point>(([x, z], [px, pz]) => [x + px, z + pz], [0, 0]);
  return points.length ? [sum[0] / points.length, sum[1] / points.length] : [0, 0];
}

/** A point of the floor in a block's own axes. */
function inwards({ x: atX, z: atZ, heading }: Block, x: number, z: number): [number, number] {
  const [sin, cos] = [Math.sin(heading), Math.cos(heading)];
  return [(x - atX) * cos - (z - atZ) * sin, (x - atX) * sin + (z - atZ) * cos];
}

function outwards({ x: atX, z: atZ, heading }: Block, u: number, v: number): [number, number] {
  const [sin, cos] = [Math.sin(heading), Math.cos(heading)];
  return [atX + u * cos + v * sin, atZ - u * sin + v * cos];
}

/** Push a body out of a block by the shortest way; its corners are round. */
function outOf(block: Block, x: number, z: number): [number, number] {
  const [u, v] = inwards(block, x, z);
  const [halfU, halfV] = block.half;
  const [nearU, nearV] = [clamp(u, halfU), clamp(v, halfV)];
  const far = Math.hypot(u - nearU, v - nearV);
  if (far >= BODY) return [x, z];
  if (far > 0) return outwards(block, nearU + ((u - nearU) / far) * BODY, nearV + ((v - nearV) / far) * BODY);
  const [overU, overV] = [halfU + BODY - Math.abs(u), halfV + BODY - Math.abs(v)];
  if (overU < overV) return outwards(block, Math.sign(u || 1) * (halfU + BODY), v);
  return outwards(block, u, Math.sign(v || 1) * (halfV + BODY));
}

/** Hold a body inside the walls. */
function into(walk: Block, x: number, z: number): [number, number] {
  const [u, v] = inwards(walk, x, z);
  const [heldU, heldV] = [clamp(u, Math.max(0, walk.half[0] - BODY)), clamp(v, Math.max(0, walk.half[1] - BODY))];
  return heldU === u && heldV === v ? [x, z] : outwards(walk, heldU, heldV);
}

function clamp(value: number, most: number): number {
  return Math.min(Math.max(value, -most), most);
}
