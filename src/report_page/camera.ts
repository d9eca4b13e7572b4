import { MathUtils, PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { prefers_stillness } from "./dom";

/** A position of the camera: the target, the direction to the eye, and the distance. */
export interface Sight {
  target: Vector3;
  direction: Vector3; // from the target to the eye
  distance: number;
}

const opening = 35; // degrees
const flight_milliseconds = 650;
/** The distance from which the whole unit ball is visible. */
const whole = 1.04 / Math.sin(MathUtils.degToRad(opening / 2));

/** The camera; pointer, fingers and keys turn it, move it and zoom. */
export class Camera {
  readonly lens = new PerspectiveCamera(opening, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private flight = 0;

  /** Starts at `home`; `on_move` is called whenever the picture must be drawn again. */
  constructor(
    canvas: HTMLElement,
    private readonly home: Sight,
    private readonly on_move: () => void,
  ) {
    this.lens.up.copy(upright(home.direction));
    this.controls = new OrbitControls(this.lens, canvas);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 1e-4;
    this.controls.maxDistance = 50;
    this.controls.addEventListener("start", () => this.end_flight());
    this.controls.addEventListener("change", () => this.on_move());
    this.look(home);
  }

  resize(width: number, height: number) {
    this.lens.aspect = width / height;
    // The shorter side of the picture shows as much as it would in a square picture.
    const half = Math.tan(MathUtils.degToRad(opening / 2));
    this.lens.fov = 2 * MathUtils.radToDeg(Math.atan(half / Math.min(1, this.lens.aspect)));
    this.lens.updateProjectionMatrix();
  }

  /** Sets the near and far planes close around the unit ball, for the best depth resolution. */
  fit_depth() {
    const distance = this.lens.position.length();
    this.lens.near = Math.max(distance - 1.1, 2e-3 * Math.min(1, this.distance()));
    this.lens.far = distance + 1.1;
    this.lens.updateProjectionMatrix();
  }

  distance(): number {
    return this.lens.position.distanceTo(this.controls.target);
  }

  sight(): Sight {
    const direction = this.lens.position.clone().sub(this.controls.target);
    return { target: this.controls.target.clone(), direction, distance: direction.length() };
  }

  /** Turns about the target by angles in radians. */
  turn(across: number, up: number) {
    const { target, direction, distance } = this.sight();
    const to_upright = new Vector3(0, 1, 0);
    const axes = this.lens.quaternion.clone();
    axes.setFromUnitVectors(this.lens.up, to_upright);
    const angles = new Spherical().setFromVector3(direction.applyQuaternion(axes));
    angles.theta -= across;
    angles.phi -= up;
    angles.makeSafe();
    const turned = new Vector3().setFromSpherical(angles).applyQuaternion(axes.invert());
    this.look({ target, direction: turned, distance });
  }

  /** Moves parallel to the picture by shares of the distance to the target. */
  pan(across: number, up: number) {
    const { target, direction, distance } = this.sight();
    const right = new Vector3().setFromMatrixColumn(this.lens.matrix, 0).multiplyScalar(across);
    const above = new Vector3().setFromMatrixColumn(this.lens.matrix, 1).multiplyScalar(up);
    this.look({
      target: target.add(right.add(above).multiplyScalar(distance)),
      direction,
      distance,
    });
  }

  zoom(factor: number) {
    const sight = this.sight();
    this.look({ ...sight, distance: sight.distance * factor });
  }

  go_home() {
    this.fly(this.home);
  }

  look_along(direction: Vector3) {
    this.fly({ ...this.home, direction, distance: whole });
  }

  /** Moves to `goal` by a short animation, or at once if the user asks for reduced motion. */
  fly(goal: Sight) {
    this.end_flight();
    if (prefers_stillness()) {
      this.look(goal);
      return;
    }
    const from = this.sight();
    const start = performance.now();
    const step = (now: number) => {
      const t = Math.min(1, (now - start) / flight_milliseconds);
      this.look(between(from, goal, t * t * (3 - 2 * t)));
      this.flight = t < 1 ? requestAnimationFrame(step) : 0;
    };
    this.flight = requestAnimationFrame(step);
  }

  private look({ target, direction, distance }: Sight) {
    this.controls.target.copy(target);
    this.lens.position.copy(direction).setLength(distance).add(target);
    this.controls.update();
    this.on_move();
  }

  private end_flight() {
    cancelAnimationFrame(this.flight);
    this.flight = 0;
  }
}

/** The axis that points upwards in the picture: y, or z for a view along y. */
function upright(direction: Vector3): Vector3 {
  const along_y = Math.abs(direction.y) > 0.8 * direction.length();
  return along_y ? new Vector3(0, 0, 1) : new Vector3(0, 1, 0);
}

/** Interpolates distances geometrically, so that the zoom is steady. */
function between(a: Sight, b: Sight, t: number): Sight {
  return {
    target: a.target.clone().lerp(b.target, t),
    direction: a.direction.clone().normalize().lerp(b.direction.clone().normalize(), t),
    distance: a.distance ** (1 - t) * b.distance ** t,
  };
}

/** A view that shows the two largest extents of the points, from slightly above. */
export function home_of(points: Float32Array): Sight {
  const extent = extent_of(points).toArray();
  const least = extent.indexOf(Math.min(...extent));
  const tilts = [new Vector3(1, 0.25, 0.35), new Vector3(0.3, 1, 0.35), new Vector3(0.35, 0.25, 1)];
  const direction = tilts[least]!.normalize();
  return { target: new Vector3(), direction, distance: distance_of(points, direction) };
}

function extent_of(points: Float32Array): Vector3 {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = low.clone().negate();
  const point = new Vector3();
  for (let i = 0; i < points.length; i += 3) {
    point.fromArray(points, i);
    low.min(point);
    high.max(point);
  }
  return high.sub(low);
}

/** The least distance from which all points fit a square picture, plus a margin of 6 %. */
function distance_of(points: Float32Array, direction: Vector3): number {
  const right = new Vector3().crossVectors(upright(direction), direction).normalize();
  const up = new Vector3().crossVectors(direction, right);
  const slope = Math.tan(MathUtils.degToRad(opening / 2));
  const point = new Vector3();
  let distance = 0;
  for (let i = 0; i < points.length; i += 3) {
    point.fromArray(points, i);
    const aside = Math.max(Math.abs(point.dot(right)), Math.abs(point.dot(up)));
    distance = Math.max(distance, aside / slope + point.dot(direction));
  }
  return 1.06 * distance || whole;
}
