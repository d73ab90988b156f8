// Channels that the radio carries only on request: each is wanted while somebody on this page shows it, and the page is seen.

export class Wants {
  private readonly owners = new Map<string, Set<string>>();

  constructor(private readonly listen: (channel: string, on: boolean) => void) {
    document.addEventListener("visibilitychange", () => this.tellAll());
  }

  set(owner: string, channels: string[], on: boolean): void {
    for (const channel of channels) {
      const owners = this.owners.get(channel) ?? new Set<string>();
      this.owners.set(channel, owners);
      if (on) owners.add(owner);
      else owners.delete(owner);
      this.tell(channel);
    }
  }

  /** After a new connection, which knows nothing. */
  tellAll(): void {
    for (const [channel, owners] of this.owners) if (owners.size > 0) this.tell(channel);
  }

  private tell(channel: string): void {
    this.listen(channel, (this.owners.get(channel)?.size ?? 0) > 0 && document.visibilityState === "visible");
  }
}
