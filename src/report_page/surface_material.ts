import { DoubleSide, GLSL3, ShaderMaterial, Vector2, Vector3, type Texture } from "three";

/**
 * Draws the surface: a colour per value, contour lines at the legend's ticks, the edges as a
 * wireframe, patches hatched. The back side of the surface is grey, so that holes and triangles of
 * opposite orientation are visible.
 */
const vertex_shader = /* glsl */ `
in float share;
in float flags;
out vec3 v_position;
out vec3 v_normal;
out vec3 v_corner;
out float v_share;
flat out int v_flags;

void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  int corner = gl_VertexID % 3;
  v_position = seen.xyz;
  v_normal = normalMatrix * normal;
  v_corner = vec3(corner == 0, corner == 1, corner == 2);
  v_share = share;
  v_flags = int(flags + 0.5);
  gl_Position = projectionMatrix * seen;
}`;

const fragment_shader = /* glsl */ `
uniform sampler2D map;
uniform bool coloured, flat_shading, wireframe, contours, patches;
uniform float fineness;  // drawn pixels along the side of one CSS pixel
uniform vec2 ticks;  // first contour and spacing, as shares of the range
uniform vec3 plain, inside, ink, accent;
in vec3 v_position;
in vec3 v_normal;
in vec3 v_corner;
in float v_share;
flat in int v_flags;
out vec4 colour;

const vec3 light = normalize(vec3(0.35, 0.55, 1.0));

float line(float distance, float width, float half_width) {
  float pixels = distance / max(width, 1e-9);
  return 1.0 - smoothstep(half_width * fineness - 0.5, half_width * fineness + 0.5, pixels);
}

float edges() {
  vec3 width = fwidth(v_corner);
  float drawn = 0.0;
  for (int i = 0; i < 3; ++i) {
    if ((v_flags & (1 << i)) != 0) drawn = max(drawn, line(v_corner[i], width[i], 0.6));
  }
  // The edges of triangles that are a few pixels wide are faded out.
  float largest = max(width.x, max(width.y, width.z)) * fineness;
  return drawn * (1.0 - smoothstep(0.12, 0.45, largest));
}

float contour() {
  float x = (v_share - ticks.x) / ticks.y;
  float width = fwidth(x);
  bool within = v_share > -0.01 && v_share < 1.01;
  return within ? line(abs(fract(x + 0.5) - 0.5), width, 0.7) * (1.0 - smoothstep(0.1, 0.4, width * fineness)) : 0.0;
}

float hatching() {
  float period = 9.0 * fineness;
  float x = (gl_FragCoord.x + gl_FragCoord.y) / period;
  return line(abs(fract(x) - 0.5), 1.0 / period, 0.8);
}

void main() {
  vec3 across = normalize(cross(dFdx(v_position), dFdy(v_position)));
  vec3 smooth_normal = normalize(v_normal) * (gl_FrontFacing ? 1.0 : -1.0);
  bool usable = !flat_shading && dot(v_normal, v_normal) > 0.01;
  vec3 normal = usable ? smooth_normal : across;
  float lit = max(dot(normal, light), 0.0);
  bool has_value = coloured && v_share > -2.5;
  bool is_patch = patches && (v_flags & 8) != 0;

  vec3 base = plain;
  if (has_value) base = texture(map, vec2(0.5 / 256.0 + clamp(v_share, 0.0, 1.0) * 255.0 / 256.0, 0.5)).rgb;
  if (is_patch && !coloured) base = mix(base, accent, 0.55);
  if (!gl_FrontFacing) base = mix(base, inside, 0.75);
  base *= coloured ? 0.66 + 0.36 * lit : 0.45 + 0.6 * lit;
  base += 0.10 * pow(lit, 24.0);
  if (is_patch) base = mix(base, ink, 0.28 * hatching());
  if (contours && has_value) base = mix(base, ink, 0.55 * contour());
  if (wireframe) base = mix(base, ink, 0.5 * edges());
  colour = vec4(base, 1.0);
}`;

export type SurfaceMaterial = ReturnType<typeof surface_material>;

export function surface_material(map: Texture) {
  const uniforms = {
    map: { value: map },
    coloured: { value: false },
    flat_shading: { value: false },
    wireframe: { value: false },
    contours: { value: false },
    patches: { value: true },
    fineness: { value: 1 },
    ticks: { value: new Vector2(0, 1) },
    plain: { value: new Vector3() },
    inside: { value: new Vector3() },
    ink: { value: new Vector3() },
    accent: { value: new Vector3() },
  };
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: vertex_shader,
    fragmentShader: fragment_shader,
    uniforms,
    side: DoubleSide,
    // Lines lie in the surface and must be drawn in front of the surface.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  return Object.assign(material, { uniforms });
}
