// The newest message of every channel, and how old it is now.

import { Hello, Item } from "./protocol";

export interface Kept { item: Item; valid_s: number }  // of the clock

export class Store {
  private readonly kept = new Map<string, Kept>();
  private stale: Hello["channels"] = {};

  /** `clock`: the time in which messages age [s]. */
  constructor(private readonly clock: () => number) {}

  greet(hello: Hello): void {
    this.stale = hello.channels;
    // Everything that is known follows. A station that was started again does not know what the one before did.
    this.kept.clear();
  }

  put(item: Item): void {
    this.kept.set(item.key, { item, valid_s: this.validTime(item) });
  }

  get<T>(key: string): T | undefined {
    return this.kept.get(key)?.item.message as T | undefined;
  }

  /** The newest message of a key. */
  newest(key: string): Kept | undefined {
    return this.kept.get(key);
  }

  /** Everything that is known, with the moment it speaks of. */
  each(act: (item: Item, valid_s: number) => void): void {
    for (const { item, valid_s } of this.kept.values()) act(item, valid_s);
  }

  /** When a message would be as old as it is now [s]. */
  validTime(item: Item): number {
    return this.clock() - item.age_s;
  }

  /** Items of a channel that keeps several, in the order of their keys. */
  all<T = Record<string, unknown>>(channel: string): Item<T>[] {
    const found: Item[] = [];
    for (const { item } of this.kept.values()) if (item.channel === channel) found.push(item);
    return found.sort((a, b) => a.key.localeCompare(b.key)) as Item<T>[];
  }

  /** Age of what the message speaks of [s]; infinite before the first one. */
  age(key: string): number {
    const kept = this.kept.get(key);
    return kept === undefined ? Infinity : this.clock() - kept.valid_s;
  }

  /** Whether a state is too old to be believed. An event does not age. */
  isStale(key: string): boolean {
    const kept = this.kept.get(key);
    if (kept === undefined) return true;
    const limit_s = this.stale[kept.item.channel]?.stale_after_s ?? 0;
    return limit_s > 0 && this.age(key) > limit_s;
  }
}
