// Programs of the graphics processor. Displacements are magnified here, so that the slider changes one number and no array.
// `depth` is that of the body of a point: bodies are drawn one above the other, each with its lines, which `lift` puts above its
// own colours; what is hidden lies behind all that is drawn.

const PLACE = `
uniform vec2 centre; uniform vec2 zoom; uniform float magnification; uniform float lift;
attribute float depth;
vec4 placed(vec2 at, vec2 moved) { return vec4((at + magnification * moved - centre) * zoom, depth - lift, 1.0); }
`;

export const fill = {
  vertex: `${PLACE}
attribute float ux; attribute float uy; attribute float value; varying float shown;
void main() { shown = value; gl_Position = placed(position.xy, vec2(ux, uy)); }`,
  fragment: `
uniform sampler2D map; uniform vec2 range; uniform float bands; uniform float lines; uniform vec3 none; varying float shown;
void main() {
  if (!(abs(shown) < 3e38)) { gl_FragColor = vec4(none, 1.0); return; }
  float part = (shown - range.x) / (range.y - range.x);
  float at = bands > 0.0 ? (floor(clamp(part, 0.0, 0.99999) * bands) + 0.5) / bands : clamp(part, 0.0, 1.0);
  vec3 colour = texture2D(map, vec2(at, 0.5)).rgb;
  if (bands > 0.0 && lines > 0.0) {
    float level = part * bands, width = fwidth(level);
    float line = 1.0 - smoothstep(0.4, 1.2, abs(fract(level - 0.5) - 0.5) / max(width, 1e-6));
    if (level > 0.5 && level < bands - 0.5 && width < 0.4) colour = mix(colour, colour * 0.55, line * lines);
  }
  gl_FragColor = vec4(colour, 1.0);
}`,
};

export const plain = {
  vertex: `${PLACE}
attribute float ux; attribute float uy; uniform float size;
void main() { gl_Position = placed(position.xy, vec2(ux, uy)); gl_PointSize = size; }`,
  fragment: `uniform vec3 colour; uniform float opacity; void main() { gl_FragColor = vec4(colour, opacity); }`,
};

// A side as four corners: wide lines, which WebGL itself does not draw.
export const side = {
  vertex: `${PLACE}
attribute vec2 from; attribute vec2 to; attribute vec2 from_moved; attribute vec2 to_moved; uniform vec2 pixel; uniform float width;
void main() {
  vec4 a = placed(from, from_moved), b = placed(to, to_moved);
  vec2 along = (b.xy - a.xy) / pixel;
  float length_ = max(length(along), 1e-6);
  vec2 across = vec2(-along.y, along.x) / length_;
  vec4 end = position.x < 0.5 ? a : b;
  gl_Position = vec4(end.xy + (position.y * across + (position.x - 0.5) * along / length_) * width * pixel, a.z, 1.0);
}`,
  fragment: plain.fragment,
};

// State of a pair by shape and colour: stick a disc, slip a triangle, open a hollow square. It stands beside the joint, in the
// direction `beside`, and covers less of it than the pairs are apart (`room`); where they are close, all of them are a band.
export const mark = {
  vertex: `${PLACE}
attribute float ux; attribute float uy; attribute float state; attribute vec2 beside; attribute float room;
uniform vec2 pixel; uniform vec2 sizes; varying float kind; varying float small;
void main() {
  kind = state;
  float size = clamp(0.6 * room * zoom.x / pixel.x, sizes.x, sizes.y);
  small = size < 0.5 * sizes.y ? 1.0 : 0.0;
  gl_Position = placed(position.xy, vec2(ux, uy));
  gl_Position.xy += beside * (0.5 * size + 0.2 * sizes.y) * pixel;
  gl_PointSize = size;
}`,
  fragment: `
uniform vec3 open; uniform vec3 stick; uniform vec3 slip; uniform vec3 paper; varying float kind; varying float small;
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  float edge;
  vec3 colour = kind < 0.5 ? open : kind < 1.5 ? stick : slip;
  if (small > 0.5) { gl_FragColor = vec4(colour, 1.0); return; }
  if (kind < 0.5) edge = max(abs(at.x), abs(at.y)) - 0.72;
  else if (kind < 1.5) edge = length(at) - 0.85;
  else edge = max(at.y - 0.75, abs(at.x) * 0.9 - 0.45 * (at.y + 0.95));
  if (edge > 0.12) discard;
  if (edge > -0.12) colour = paper;
  else if (kind < 0.5 && edge < -0.4) colour = paper;
  gl_FragColor = vec4(colour, 1.0);
}`,
};
