/** The current settings of the view; controls and drawing code listen to their changes. */
export interface ViewState {
  shown: number; // which state of the mesh
  split: boolean; // show the first state left of `split_at` and the last state right of it
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

  /** Calls `listener` once immediately, and again at every change. */
  on_change(listener: (state: ViewState) => void) {
    this.listeners.push(listener);
    listener(this.state);
  }
}
