// Owns which robots the page shows: the one that served it, and those that it was told of. Others are never asked for.
import { Robot } from "./robot";
import { Signal, type Readable } from "./signal";

export interface Known {
  /** As browsers name it: host and port. */
  readonly address: string;
  /** In an order that is the same on the pages of all of them: robots keep their colours. */
  readonly at: number;
  readonly isOwn: boolean;
  /** Its connection, which begins when somebody asks for it first. */
  readonly robot: Robot;
}

/** What a robot calls others that browsers can reach. */
const ADDRESS = /^[a-z0-9.\-[\]:]+:\d+$/i;

export class Robots {
  readonly own: Robot;
  private readonly others = new Map<string, Robot>();
  private readonly list: Signal<readonly Known[]>;

  /** The address of the robot that served the page, and that of its WebSocket. */
  constructor(
    private readonly address: string,
    socket: string,
  ) {
    this.own = new Robot(socket, "token");
    this.list = new Signal<readonly Known[]>([this.entry(address, 0)]);
    this.own.welcome.watch((welcome) => {
      if (welcome !== null) this.learn(Array.isArray(welcome.peers) ? welcome.peers : []);
    });
  }

  /** At least the own one. Changes when the robot names others. */
  get known(): Readable<readonly Known[]> {
    return this.list;
  }

  /** Null: this page may not show it. Without an address: the own one. */
  find(address: string | undefined): Known | null {
    const wanted = address ?? this.address;
    return this.list.value.find((known) => known.address === wanted) ?? null;
  }

  private learn(peers: readonly unknown[]): void {
    const named = peers.filter((peer): peer is string => typeof peer === "string" && ADDRESS.test(peer));
    const addresses = [...new Set([this.address, ...named])].sort();
    if (addresses.join() === this.list.value.map((known) => known.address).join()) return;
    this.list.set(addresses.map((address, at) => this.entry(address, at)));
    for (const [address, robot] of this.others) {
      if (addresses.includes(address)) continue;
      robot.close();
      this.others.delete(address);
    }
  }

  private entry(address: string, at: number): Known {
    const robot = (): Robot => (address === this.address ? this.own : this.connection(address));
    return {
      address,
      at,
      isOwn: address === this.address,
      get robot() {
        return robot();
      },
    };
  }

  private connection(address: string): Robot {
    let robot = this.others.get(address);
    if (robot === undefined) {
      // A token is told to the robot alone for which somebody typed it.
      robot = new Robot(`ws://${address}/socket`, `token ${address}`);
      this.others.set(address, robot);
    }
    return robot;
  }
}
