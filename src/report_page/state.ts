/** What the view shows at the moment; whoever shows or changes a part of it listens here. */
export interface ViewState {
  shown: number; // which state of the mesh
  split: boolean; // the first state left of `split_at`, the last right of it
  split_at: number; // share of the width
  field: number; // index into the scene's fields, -1 for plain
  wireframe: boolean;
  flat: boolean;
  contours: boolean;
  patches: boolean;
  lines: boolean;
}

export class Store {
  private listeners: ((state: ViewState) => void)[] = [];

  constructor(private state: ViewState) {}

  get now(): Readonly<ViewState> {
    return this.state;
  }

  set(changes: Partial<ViewState>) {
    this.state = { ...this.state, ...changes };
    for (const listener of this.listeners) listener(this.state);
  }

  /** Calls `listener` at every change, and once now. */
  on_change(listener: (state: ViewState) => void) {
    this.listeners.push(listener);
    listener(this.state);
  }
}
