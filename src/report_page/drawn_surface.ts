import { BufferAttribute, BufferGeometry, Group, Mesh } from "three";
import type { Field } from "./payload";
import { no_value, shares_of, type SurfaceState } from "./surface";
import type { SurfaceMaterial } from "./surface_material";

/**
 * One state of the mesh on the graphics card. By default, triangles share their vertices, which is
 * fastest. To show values per triangle, edges or patches, each triangle needs corners of its own;
 * this second layout is made when it is first needed.
 */
export class DrawnSurface {
  readonly group = new Group();
  private readonly shared: Mesh;
  private apart: Mesh | null = null;
  private shares = new Float32Array(0);
  private on: Field["on"] = "vertex";

  constructor(
    private readonly state: SurfaceState,
    private readonly flags: Uint8Array,
    private readonly material: SurfaceMaterial,
  ) {
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(state.indices, 1));
    geometry.setAttribute("position", new BufferAttribute(state.points, 3));
    geometry.setAttribute("normal", new BufferAttribute(state.normals, 4, true));
    this.shared = this.add(geometry);
    this.colour(undefined, null);
  }

  /** Sets the values of a field; `values` is null if this state has none. */
  colour(field: Field | undefined, values: Float32Array | null) {
    const vertices = this.state.points.length / 3;
    this.on = field && values ? field.on : "vertex";
    const known = field && values ? shares_of(field, values) : new Float32Array();
    const count = this.on === "vertex" ? vertices : this.state.triangles;
    // The arrays hold the vertices of all states; those beyond `values` get no value.
    this.shares = new Float32Array(count).fill(no_value);
    this.shares.set(known.subarray(0, count));
    if (this.on === "vertex") set(this.shared, "share", this.shares, 1);
    if (this.apart) set(this.apart, "share", this.shares_of_corners(), 1);
  }

  /** Draws triangles with corners of their own if needed, and with shared vertices otherwise. */
  show(with_triangles: boolean) {
    const apart = with_triangles || this.on === "triangle";
    if (apart && !this.apart) this.apart = this.lay_out_corners();
    this.shared.visible = !apart;
    if (this.apart) this.apart.visible = apart;
  }

  private lay_out_corners(): Mesh {
    const { indices, points, normals } = this.state;
    const mesh = this.add(new BufferGeometry());
    const positions = new Float32Array(3 * indices.length);
    const directions = new Int16Array(4 * indices.length);
    for (let c = 0; c < indices.length; ++c) {
      const v = indices[c]!;
      for (let k = 0; k < 3; ++k) {
        positions[3 * c + k] = points[3 * v + k]!;
        directions[4 * c + k] = normals[4 * v + k]!;
      }
    }
    set(mesh, "position", positions, 3);
    mesh.geometry.setAttribute("normal", new BufferAttribute(directions, 4, true));
    mesh.geometry.setAttribute("flags", new BufferAttribute(this.flags, 1));
    set(mesh, "share", this.shares_of_corners(), 1);
    return mesh;
  }

  private shares_of_corners(): Float32Array {
    const { indices } = this.state;
    const corners = new Float32Array(indices.length);
    for (let c = 0; c < corners.length; ++c) {
      corners[c] = this.shares[this.on === "vertex" ? indices[c]! : Math.floor(c / 3)]!;
    }
    return corners;
  }

  private add(geometry: BufferGeometry): Mesh {
    const mesh = new Mesh(geometry, this.material);
    mesh.frustumCulled = false; // culling would need bounds, and this is the only mesh
    this.group.add(mesh);
    return mesh;
  }
}

function set(mesh: Mesh, name: string, values: Float32Array, size: number) {
  mesh.geometry.setAttribute(name, new BufferAttribute(values, size));
}
