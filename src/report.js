R"js(// The report's 3-D view and panel. Input: the JSON in #data (written by report.cpp). No library, no network.
//
// All geometry is fetched by number: positions, triangles and labels lie in textures, the vertex shaders pick from them by
// gl_VertexID. So a labeling is switched by one texture, and the morph to the polycube is one uniform.
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const element = id => document.getElementById(id);

// ---- data

function decode(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}
function integers(packed) {
  return new { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[packed.bytes](decode(packed.data).buffer);
}
const floats = base64 => new Float32Array(decode(base64).buffer);

const points = floats(data.points);                                              // 3 per vertex, within the unit ball
const polycube = data.polycube ? floats(data.polycube) : null;
const triangles = integers(data.triangles);                                      // 3 vertices per facet
const features = integers(data.features);                                        // 2 vertices per edge
const layers = data.layers.map(layer => {
  const unpacked = { name: layer.name, statistics: layer.statistics, problems: layer.problems };
  for (const key of ['labels', 'charts', 'invalid_charts', 'borders', 'invalid_borders', 'corners', 'invalid_corners',
                     'turning_points', 'lost'])
    unpacked[key] = integers(layer[key]);
  return unpacked;
});

const LABELS = ['+X', '-X', '+Y', '-Y', '+Z', '-Z'];
const COLOURS = ['#ff0000', '#990000', '#ffffff', '#999999', '#0000ff', '#000099'];

const corner = (f, k) => { const v = 3 * triangles[3 * f + k]; return [points[v], points[v + 1], points[v + 2]]; };
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const n = Math.sqrt(dot(a, a)); return n > 0 ? a.map(x => x / n) : a; };
const area_vector = f => cross(minus(corner(f, 1), corner(f, 0)), minus(corner(f, 2), corner(f, 0)));
const normal = f => unit(area_vector(f));

// (n . direction + 1) / 2. From coordinates in single precision: three digits are right, but on slivers.
function fidelity(f, label) {
  return (normal(f)[label >> 1] * (label % 2 ? -1 : 1) + 1) / 2;
}

// The outward direction at a problem: facet normals, of its chart by area, else those nearest to its place.
function outward(problem) {
  const sum = [0, 0, 0], [x, y, z] = problem.at, charts = layer().charts;
  for (let f = 0; f < data.facets; f++) {
    if (problem.kind === 'chart' && charts[f] !== problem.element) continue;
    let nearest = Infinity;
    for (let k = 0; k < 3; k++) {
      const v = 3 * triangles[3 * f + k];
      nearest = Math.min(nearest, (points[v] - x) ** 2 + (points[v + 1] - y) ** 2 + (points[v + 2] - z) ** 2);
    }
    const weight = problem.kind === 'chart' ? 1 : 1e-12 / (1e-6 + nearest) ** 2;
    if (weight < 1e-4) continue;                                                 // far away: not worth its normal
    const n = area_vector(f), scale_ = problem.kind === 'chart' ? 1 : weight / (Math.hypot(...n) || 1);
    for (let a = 0; a < 3; a++) sum[a] += scale_ * n[a];
  }
  return unit(sum);
}

// ---- state

const HOME = { yaw: 0.6, pitch: 0.45, zoom: 0.92, at: [0, 0, 0] };               // zoom: half the view's height is 1 / zoom
let camera = { ...HOME };
const shown = { layer: layers.length - 1, fidelity: false, morph: 0, problem: -1 };
const hidden = new Set();                                                        // names of groups that are switched off
const layer = () => layers[shown.layer];

// What is drawn over the facets, bottom to top. Told apart by width, dashes and shape as well as by colour.
// width in CSS pixels; xray: shines through the part.
const GROUPS = [
  { name: 'boundary', width: 2, colour: '#000000', casing: '#000000',
    edges: l => l.borders },
  { name: 'feature edge kept', width: 4, colour: '#19d27c', casing: '#000000',
    edges: l => pairs(features, i => !l.lost[i]) },
  { name: 'feature edge lost', width: 6, colour: '#ff9a00', casing: '#000000', dashed: true,
    edges: l => pairs(features, i => l.lost[i]) },
  { name: 'invalid boundary', width: 8, colour: '#ff1fc7', casing: '#ffffff', xray: true,
    edges: l => pairs(l.borders, i => l.invalid_borders[i]) },
  { name: 'corner', width: 8, colour: '#ffffff', casing: '#000000', shape: 1,
    vertices: l => l.corners.filter((v, i) => !l.invalid_corners[i]) },
  { name: 'turning-point', width: 16, colour: '#ffd400', casing: '#000000', shape: 1, xray: true,
    vertices: l => l.turning_points },
  { name: 'invalid corner', width: 18, colour: '#ff1fc7', casing: '#ffffff', shape: 2, xray: true,
    vertices: l => l.corners.filter((v, i) => l.invalid_corners[i]) },
];
function pairs(edges, wanted) {
  const out = [];
  for (let i = 0; 2 * i < edges.length; i++) if (wanted(i)) out.push(edges[2 * i], edges[2 * i + 1]);
  return Uint32Array.from(out);
}

// ---- drawing

const canvas = element('canvas');
const gl = canvas.getContext('webgl2', { antialias: true });
const WIDTH = 2048;                                                              // of all textures; the least that WebGL 2 allows

const COMMON = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
precision highp sampler2D;
uniform sampler2D points, polycube;
uniform float morph;
uniform mat3 turn;          // rows: to the right, up, toward the viewer
uniform vec3 at;            // centre of the view
uniform vec2 zoom;          // to clip space
ivec2 cell(int i) { return ivec2(i % ${WIDTH}, i / ${WIDTH}); }
vec3 place(int v) {
  vec3 p = texelFetch(points, cell(v), 0).xyz;
  return morph == 0.0 ? p : mix(p, texelFetch(polycube, cell(v), 0).xyz, morph);
}
vec4 project(vec3 p) { vec3 q = turn * (p - at); return vec4(q.xy * zoom, -0.24 * q.z, 1); }
`;

const FACET_VERTEX = COMMON + `
uniform usampler2D triangles, facets;    // of a facet: label, + 8 if its chart is invalid
uniform int mode;
flat out vec3 normal;
flat out uint code, number;
flat out float fidelity;
vec3 normal_of(vec3 a, vec3 b, vec3 c) { vec3 n = cross(b - a, c - a); float l = length(n); return l > 0.0 ? n / l : vec3(0); }
void main() {
  int f = gl_VertexID / 3;
  int v[3];
  for (int k = 0; k < 3; k++) v[k] = int(texelFetch(triangles, cell(3 * f + k), 0).r);
  vec3 p[3] = vec3[3](place(v[0]), place(v[1]), place(v[2]));
  normal = turn * normal_of(p[0], p[1], p[2]);
  number = uint(f + 1);
  code = texelFetch(facets, cell(f), 0).r;
  fidelity = 0.0;
  if (mode == 1) {
    vec3 n = normal_of(texelFetch(points, cell(v[0]), 0).xyz, texelFetch(points, cell(v[1]), 0).xyz,
                       texelFetch(points, cell(v[2]), 0).xyz);
    int label = int(code & 7u);
    fidelity = (n[label / 2] * (label % 2 == 0 ? 1.0 : -1.0) + 1.0) / 2.0;
  }
  gl_Position = project(p[gl_VertexID % 3]);
}`;
const FACET_FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
uniform vec3 palette[6];
uniform int mode;                        // 0 labels, 1 fidelity, 2 the facet's number
uniform float pixel;                     // device pixels per CSS pixel
flat in vec3 normal;
flat in uint code, number;
flat in float fidelity;
out vec4 colour;
// From dark violet at 0.5 through green to yellow at 1: ordered in lightness too.
vec3 ramp(float f) {
  float t = clamp(2.0 * f - 1.0, 0.0, 1.0);
  return t < 0.6 ? mix(vec3(0.20, 0.02, 0.35), vec3(0.10, 0.56, 0.55), t / 0.6)
                 : mix(vec3(0.10, 0.56, 0.55), vec3(1.0, 0.92, 0.35), (t - 0.6) / 0.4);
}
void main() {
  if (mode == 2) {
    colour = vec4(number & 255u, number >> 8 & 255u, number >> 16 & 255u, number >> 24) / 255.0;
    return;
  }
  vec3 base = mode == 1 ? ramp(fidelity) : palette[int(code & 7u)];
  if ((code & 8u) != 0u) {               // an invalid chart is striped
    float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / pixel, 16.0);
    if (stripe < 7.0) base = stripe < 1.0 || stripe >= 6.0 ? vec3(1) : vec3(1.0, 0.12, 0.78);
  }
  colour = vec4(base * (0.6 + 0.4 * abs(normal.z)), 1);
}`;

// An edge or a vertex is a rectangle in the plane of the screen: two triangles. (As instances of four vertices they would take
// several times as long.)
const MARK_VERTEX = COMMON + `
uniform usampler2D elements;
uniform int per_element;                 // vertices: 2 an edge, 1 a point
uniform vec2 screen;                     // half the size of the canvas in pixels
uniform float width, lift;
out vec2 local;                          // pixels from the axis, or from the centre
out float along;                         // pixels along the edge
void main() {
  int k = gl_VertexID % 6 < 3 ? gl_VertexID % 6 : gl_VertexID % 6 - 2;     // of its four corners: 0 1 2, 1 2 3
  vec2 side = vec2(k % 2, k / 2) * 2.0 - 1.0;
  int i = gl_VertexID / 6 * per_element;
  vec4 a = project(place(int(texelFetch(elements, cell(i), 0).r)));
  float half_width = width / 2.0 + 1.0;
  along = 0.0;
  if (per_element == 1) {
    local = side * half_width;
    gl_Position = a + vec4(local / screen, 0, 0);
  } else {
    vec4 b = project(place(int(texelFetch(elements, cell(i + 1), 0).r)));
    vec2 edge = (b.xy - a.xy) * screen;
    float length_ = length(edge);
    vec2 d = length_ > 0.0 ? edge / length_ : vec2(1, 0);
    gl_Position = (side.x < 0.0 ? a : b) +
                  vec4((d * side.x * width * 0.35 + vec2(-d.y, d.x) * side.y * half_width) / screen, 0, 0);
    local = vec2(0, side.y * half_width);
    along = side.x < 0.0 ? 0.0 : length_;
  }
  // Over the facets beside it, which may come toward the viewer within its width.
  gl_Position.z -= lift + 0.4 * width / (screen.y * zoom.y);
}`;
const MARK_FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 inner, casing;
uniform float width, alpha, pixel;
uniform int shape;                       // 0 edge, 1 disc, 2 diamond
uniform bool dashed;
in vec2 local;
in float along;
out vec4 colour;
void main() {
  float r = shape == 2 ? abs(local.x) + abs(local.y) : length(local);
  float rim = width / 2.0, core = rim - (shape == 0 ? max(1.25 * pixel, 0.27 * width) : 2.0 * pixel);
  float inside = clamp(rim - r + 0.5, 0.0, 1.0);
  if (inside == 0.0) discard;
  float fill = clamp(core - r + 0.5, 0.0, 1.0);
  if (dashed && mod(along, 12.0 * pixel) > 7.0 * pixel) fill = 0.0;
  colour = vec4(mix(casing, inner, fill), inside * alpha);
}`;

function compile(vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
    const name = gl.getActiveUniform(program, i).name.replace('[0]', '');
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

// A texture from which shaders read entry i at (i % WIDTH, i / WIDTH).
function texture(array, channels, old) {
  const [internal, format, type] =
      array instanceof Float32Array ? [gl.RGB32F, gl.RGB, gl.FLOAT]
    : array instanceof Uint8Array   ? [gl.R8UI, gl.RED_INTEGER, gl.UNSIGNED_BYTE]
    : array instanceof Uint16Array  ? [gl.R16UI, gl.RED_INTEGER, gl.UNSIGNED_SHORT]
                                    : [gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT];
  const height = Math.max(1, Math.ceil(array.length / channels / WIDTH));
  const padded = new array.constructor(WIDTH * height * channels);
  padded.set(array);
  const made = old || gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, internal, WIDTH, height, 0, format, type, padded);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return made;
}

const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);
let gpu = null;

function start_drawing() {
  gpu = { facet: compile(FACET_VERTEX, FACET_FRAGMENT), mark: compile(MARK_VERTEX, MARK_FRAGMENT),
          points: texture(points, 3), triangles: texture(triangles, 1) };
  gpu.polycube = polycube ? texture(polycube, 3) : gpu.points;
  gpu.pick = { frame: gl.createFramebuffer(), colour: gl.createRenderbuffer(), depth: gl.createRenderbuffer(), fresh: false };
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
}

// The textures of the layer that is shown.
function load_layer() {
  const l = layer(), codes = new Uint8Array(data.facets);
  for (let f = 0; f < data.facets; f++) codes[f] = l.labels[f] + 8 * l.invalid_charts[l.charts[f]];
  gpu.facets = texture(codes, 1, gpu.facets);
  for (const group of GROUPS) {
    const elements = (group.edges || group.vertices)(l);
    group.count = elements.length / (group.edges ? 2 : 1);
    group.texture = texture(Uint32Array.from(elements), 1, group.texture);
  }
}

function basis() {
  const { yaw, pitch } = camera, c = Math.cos(pitch);
  const toward = [c * Math.cos(yaw), c * Math.sin(yaw), Math.sin(pitch)], right = [-Math.sin(yaw), Math.cos(yaw), 0];
  return { right, up: cross(toward, right), toward };
}

function use({ program, uniforms }, textures) {
  gl.useProgram(program);
  Object.entries({ points: gpu.points, polycube: gpu.polycube, ...textures }).forEach(([name, bound], unit_) => {
    gl.activeTexture(gl.TEXTURE0 + unit_);
    gl.bindTexture(gl.TEXTURE_2D, bound);
    gl.uniform1i(uniforms[name], unit_);
  });
  gl.activeTexture(gl.TEXTURE0);
  const { right: r, up: u, toward: t } = basis(), aspect = canvas.width / canvas.height, fit = Math.min(1, aspect);
  gl.uniformMatrix3fv(uniforms.turn, false, [r[0], u[0], t[0], r[1], u[1], t[1], r[2], u[2], t[2]]);
  gl.uniform3fv(uniforms.at, camera.at);
  gl.uniform2f(uniforms.zoom, camera.zoom * fit / aspect, camera.zoom * fit);
  gl.uniform1f(uniforms.morph, shown.morph);
  gl.uniform1f(uniforms.pixel, devicePixelRatio);
  return uniforms;
}

function draw_facets(mode) {
  const uniforms = use(gpu.facet, { triangles: gpu.triangles, facets: gpu.facets });
  gl.uniform3fv(uniforms.palette, COLOURS.flatMap(rgb));
  gl.uniform1i(uniforms.mode, mode);
  gl.drawArrays(gl.TRIANGLES, 0, 3 * data.facets);
}

function draw_group(group, rank) {
  if (!group.count || hidden.has(group.name)) return;
  const uniforms = use(gpu.mark, { elements: group.texture });
  gl.uniform1i(uniforms.per_element, group.edges ? 2 : 1);
  gl.uniform2f(uniforms.screen, canvas.width / 2, canvas.height / 2);
  gl.uniform1f(uniforms.width, group.width * devicePixelRatio);
  gl.uniform1f(uniforms.lift, 0.0002 * rank);
  gl.uniform3fv(uniforms.inner, rgb(group.colour));
  gl.uniform3fv(uniforms.casing, rgb(group.casing));
  gl.uniform1i(uniforms.shape, group.shape || 0);
  gl.uniform1i(uniforms.dashed, group.dashed ? 1 : 0);
  for (const through of group.xray ? [true, false] : [false]) {
    (through ? gl.disable : gl.enable).call(gl, gl.DEPTH_TEST);
    gl.uniform1f(uniforms.alpha, through ? 0.4 : 1);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * group.count);
  }
}

function draw() {
  const width = Math.round(canvas.clientWidth * devicePixelRatio), height = Math.round(canvas.clientHeight * devicePixelRatio);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  gl.viewport(0, 0, width, height);
  gl.clearColor(0.70, 0.74, 0.78, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.disable(gl.BLEND);
  draw_facets(shown.fidelity ? 1 : 0);
  gl.enable(gl.BLEND);
  GROUPS.forEach(draw_group);
  gl.disable(gl.BLEND);
  gpu.pick.fresh = false;
  draw_axes();
  place_target();
}

let waiting = false;
function redraw() {
  if (waiting || !gpu) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
}

// The facet at a place of the canvas (CSS pixels), or -1. The numbers of all facets are drawn once per view, then looked up.
function facet_at(x, y) {
  const { frame, colour, depth } = gpu.pick, width = canvas.clientWidth | 0, height = canvas.clientHeight | 0;
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  if (!gpu.pick.fresh) {
    for (const [buffer, format, where] of [[colour, gl.RGBA8, gl.COLOR_ATTACHMENT0], [depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, where, gl.RENDERBUFFER, buffer);
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    draw_facets(2);
    gpu.pick.fresh = true;
  }
  const pixel = new Uint8Array(4);
  gl.readPixels(x | 0, height - 1 - (y | 0), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] + 16777216 * pixel[3] - 1;
}

// ---- camera

// CSS pixels per unit of the scene.
const scale = () => camera.zoom * Math.min(canvas.clientWidth, canvas.clientHeight) / 2;

function orbit(dx, dy) {
  camera.yaw -= dx;
  camera.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, camera.pitch + dy));
  redraw();
}
function pan(dx, dy) {                                                           // CSS pixels
  const { right, up } = basis(), s = scale();
  camera.at = camera.at.map((x, a) => x - (right[a] * dx - up[a] * dy) / s);
  redraw();
}
function zoom(factor, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) { // the scene's point under x y stays there
  const dx = x - canvas.clientWidth / 2, dy = y - canvas.clientHeight / 2, before = camera.zoom;
  camera.zoom = Math.max(0.2, Math.min(1e5, before * factor));
  pan(dx * (1 - camera.zoom / before), dy * (1 - camera.zoom / before));
}
// To another camera within 0.4 s, or at once for those who ask for little motion.
let flight = 0;
function fly(goal) {
  const from = { ...camera }, began = performance.now(), mine = ++flight;
  const turn = Math.atan2(Math.sin(goal.yaw - from.yaw), Math.cos(goal.yaw - from.yaw));
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  const step = now => {
    if (mine !== flight) return;
    const t = still ? 1 : Math.min(1, Math.max(0, now - began) / 400), s = t * t * (3 - 2 * t);
    camera = { yaw: from.yaw + s * turn, pitch: from.pitch + s * (goal.pitch - from.pitch),
               zoom: from.zoom * (goal.zoom / from.zoom) ** s, at: from.at.map((x, a) => x + s * (goal.at[a] - x)) };
    redraw();
    if (t < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
function look_along(direction, at, zoom_) {
  fly({ yaw: Math.atan2(direction[1], direction[0]), pitch: Math.asin(Math.max(-1, Math.min(1, direction[2]))), zoom: zoom_, at });
}

function show_problem(number) {
  const problem = layer().problems[number];
  if (!problem) return;
  shown.problem = number;
  set_morph(0);
  const n = outward(problem), tilted = unit([n[0] + 0.2, n[1] + 0.1, n[2] + 0.25]);
  look_along(tilted, problem.at, Math.max(1.2, Math.min(1e4, 0.5 / problem.radius)));
  element('problems').querySelectorAll('button').forEach((button, i) => {
    button.classList.toggle('now', i === number);
    if (i === number) button.scrollIntoView({ block: 'nearest' });
  });
}

// ---- over the canvas

function draw_axes() {
  const { right, up, toward } = basis();
  element('axes').innerHTML = [0, 1, 2].sort((a, b) => toward[a] - toward[b]).map(a => {
    const x = 34 * right[a], y = -34 * up[a];
    return `<line x2="${x}" y2="${y}" stroke="${COLOURS[2 * a]}"/><text x="${1.3 * x}" y="${1.3 * y}">${'XYZ'[a]}</text>`;
  }).join('');
}

function place_target() {
  const problem = layer().problems[shown.problem], ring = element('target');
  ring.hidden = !problem || shown.morph > 0;
  if (ring.hidden) return;
  const d = minus(problem.at, camera.at), { right, up } = basis(), s = scale();
  ring.style.left = canvas.clientWidth / 2 + s * dot(right, d) + 'px';
  ring.style.top = canvas.clientHeight / 2 - s * dot(up, d) + 'px';
}

function show_tip(x, y) {
  const tip = element('tip'), f = facet_at(x, y);
  tip.hidden = f < 0;
  if (f < 0) return;
  const l = layer(), chart = l.charts[f], label = l.labels[f];
  tip.textContent = `facet ${f}, ${LABELS[label]}, fidelity ${fidelity(f, label).toFixed(3)}\n` +
      `chart ${chart}${l.invalid_charts[chart] ? ', invalid' : ''}\n` +
      layers.map(other => `${other.name} ${LABELS[other.labels[f]]}`).join(', ');
  tip.style.left = Math.max(0, Math.min(x + 14, canvas.clientWidth - tip.offsetWidth - 4)) + 'px';
  tip.style.top = (y + 18 + tip.offsetHeight > canvas.clientHeight ? y - 12 - tip.offsetHeight : y + 18) + 'px';
}

// ---- mouse, touch, keyboard

const pointers = new Map();                                                      // id -> last place
canvas.addEventListener('pointerdown', event => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  element('tip').hidden = true;
  flight++;
});
for (const name of ['pointerup', 'pointercancel'])
  canvas.addEventListener(name, event => pointers.delete(event.pointerId));
canvas.addEventListener('pointerleave', () => { element('tip').hidden = true; });
let tip_at = null;
canvas.addEventListener('pointermove', event => {
  const x = event.offsetX, y = event.offsetY, last = pointers.get(event.pointerId);
  if (!last) {                                                                   // once per frame, not once per event
    if (!tip_at) requestAnimationFrame(() => { if (gpu && !pointers.size) show_tip(...tip_at); tip_at = null; });
    tip_at = [x, y];
    return;
  }
  const other = [...pointers].find(([id]) => id !== event.pointerId);
  if (other) {                                                                   // two fingers: each does half of the pan
    const o = other[1], distance = p => Math.hypot(p.x - o.x, p.y - o.y);
    pan((x - last.x) / 2, (y - last.y) / 2);
    if (distance(last) > 0) zoom(distance({ x, y }) / distance(last), (x + o.x) / 2, (y + o.y) / 2);
  } else if (event.shiftKey || event.buttons & 6) {
    pan(x - last.x, y - last.y);
  } else {
    orbit((x - last.x) * 0.008, (y - last.y) * 0.008);
  }
  pointers.set(event.pointerId, { x, y });
});
canvas.addEventListener('contextmenu', event => event.preventDefault());
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  flight++;
  zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), event.offsetX, event.offsetY);
}, { passive: false });
canvas.addEventListener('dblclick', event => {
  const f = facet_at(event.offsetX, event.offsetY);
  if (f >= 0) fly({ ...camera, at: corner(f, 0), zoom: Math.max(camera.zoom, 3) });
});

addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === 'INPUT') return;
  const move = (dx, dy) => event.shiftKey ? pan(-400 * dx, 400 * dy) : orbit(dx, dy);
  const actions = {
    ArrowLeft: () => move(0.1, 0), ArrowRight: () => move(-0.1, 0), ArrowUp: () => move(0, 0.1), ArrowDown: () => move(0, -0.1),
    '+': () => zoom(1.2), '=': () => zoom(1.2), '-': () => zoom(1 / 1.2), Home: () => fly(HOME),
    x: () => fly({ ...camera, yaw: 0, pitch: 0 }), y: () => fly({ ...camera, yaw: -Math.PI / 2, pitch: 0 }),
    z: () => fly({ ...camera, yaw: -Math.PI / 2, pitch: Math.PI / 2 }),
    f: () => { shown.fidelity = !shown.fidelity; refresh(); },
    m: () => morph_to(shown.morph < 0.5 ? 1 : 0),
    n: () => show_problem((shown.problem + 1) % layer().problems.length),
    p: () => show_problem((Math.max(shown.problem, 0) + layer().problems.length - 1) % layer().problems.length),
  };
  const number = Number(event.key) - 1;
  if (layers[number]) choose_layer(number);
  else if (actions[event.key]) actions[event.key]();
  else return;
  event.preventDefault();
});

// ---- panel

function create(tag, content, properties = {}) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...[content].flat());
  return made;
}

function set_morph(t) {
  shown.morph = polycube ? t : 0;
  element('morph').querySelector('input').value = shown.morph;
  redraw();
}
function morph_to(goal) {
  const from = shown.morph, began = performance.now();
  const step = now => {
    const t = Math.min(1, Math.max(0, now - began) / 900);
    set_morph(from + t * (goal - from));
    if (t < 1) requestAnimationFrame(step);
  };
  if (polycube) requestAnimationFrame(step);
}

function choose_layer(number) {
  shown.layer = number;
  shown.problem = -1;
  if (gpu) load_layer();
  refresh();
}

function choice(id, names, chosen, choose) {
  element(id).replaceChildren(...names.map((name, i) => {
    const button = create('button', name, { type: 'button', onclick: () => choose(i) });
    button.setAttribute('aria-pressed', i === chosen);
    return button;
  }));
}

function swatch(group) {
  const dash = group.dashed ? 'stroke-dasharray="6 4"' : '', w = Math.min(group.width, 14);
  const mark = group.edges
    ? `<path d="M0 8h26" stroke="${group.casing}" stroke-width="${w}"/><path d="M0 8h26" stroke="${group.colour}" stroke-width="${w / 2}" ${dash}/>`
    : group.shape === 2 ? `<path d="M13 1l7 7-7 7-7-7z" fill="${group.colour}" stroke="${group.casing}"/>`
    : `<circle cx="13" cy="8" r="${w / 2}" fill="${group.colour}" stroke="${group.casing}" stroke-width="2"/>`;
  return `<svg width="26" height="16">${mark}</svg>`;
}

function fill_legend() {
  const colours = create('div', [], { className: 'wide' });
  if (shown.fidelity) {
    colours.append(create('span', 'fidelity 0.5 or less … 1'));
    colours.firstChild.style.cssText =
        'background: linear-gradient(90deg, rgb(51 5 89), rgb(26 143 140) 60%, rgb(255 235 89)); color: #fff; text-shadow: 0 0 3px #000';
  } else {
    LABELS.forEach((name, i) => {
      const cell = create('span', name);
      cell.style.cssText = `background: ${COLOURS[i]}; color: ${i === 2 || i === 3 ? '#000' : '#fff'}`;
      colours.append(cell);
    });
  }
  const striped = layer().invalid_charts.reduce((n, x) => n + x, 0);
  const stripes = create('span', `${striped} invalid chart${striped === 1 ? '' : 's'}: striped`);
  stripes.style.cssText = 'background: repeating-linear-gradient(135deg, #ffc9f1 0 7px, #fff 7px 14px)';
  const rows = GROUPS.filter(group => group.count).map(group => {
    const box = create('input', [], { type: 'checkbox', checked: !hidden.has(group.name), onchange: () => {
      hidden[box.checked ? 'delete' : 'add'](group.name);
      redraw();
    } });
    const row = create('label', box);
    row.insertAdjacentHTML('beforeend', swatch(group));
    row.append(group.name);
    return row;
  });
  element('legend').replaceChildren(colours, ...(striped ? [create('div', stripes, { className: 'wide' })] : []), ...rows);
}

const LISTED = 500;                                                              // problems; a list of many thousands helps nobody
function fill_problems() {
  const problems = layer().problems;
  element('problem_count').textContent = `(${problems.length})`;
  element('problems').replaceChildren(...problems.slice(0, LISTED).map((problem, i) =>
    create('li', create('button', problem.text, { type: 'button', className: problem.kind, onclick: () => show_problem(i) }))));
  if (!problems.length) element('problems').append(create('li', 'none: valid, and every boundary is monotone'));
  if (problems.length > LISTED) element('problems').append(create('li', `and ${problems.length - LISTED} more`));
}

// Everything that depends on what is chosen.
function refresh() {
  const verdict = layer().statistics.class;
  element('verdict').replaceChildren(`${layer().name}: `, create('b', verdict, { className: verdict === 'invalid' ? 'bad' : '' }),
                                     `. ${data.facets} facets, ${data.vertices} vertices. ${verdict === 'invalid' ? data.hint : ''}`);
  choice('layers', layers.map(l => l.name), shown.layer, choose_layer);
  choice('maps', ['labels', 'fidelity'], shown.fidelity ? 1 : 0, i => { shown.fidelity = i === 1; refresh(); });
  fill_legend();
  fill_problems();
  redraw();
}

function fill_tables() {
  element('statistics').replaceChildren(
    create('tr', [create('td', ''), ...layers.map(l => create('th', l.name))]),
    ...Object.keys(layers[0].statistics).map(key =>
      create('tr', [create('td', key), ...layers.map(l => create('td', String(l.statistics[key])))])));
  element('parameters').replaceChildren(...Object.entries(data.parameters).map(([name, value]) =>
    create('tr', [create('td', name), create('td', value)])));
}

document.querySelector('h1').textContent = data.title;
element('morph').hidden = !polycube;
element('morph').querySelector('input').oninput = event => set_morph(Number(event.target.value));
fill_tables();
if (gl) {
  start_drawing();
  load_layer();
  addEventListener('resize', redraw);
  new ResizeObserver(redraw).observe(canvas);
  canvas.addEventListener('webglcontextlost', event => event.preventDefault());
  canvas.addEventListener('webglcontextrestored', () => {
    GROUPS.forEach(group => { delete group.texture; });
    start_drawing();
    load_layer();
    redraw();
  });
} else {
  element('trouble').hidden = false;
  element('trouble').textContent = 'This browser has no WebGL 2 here, so there is no 3-D view. Tables and problems are at the side.';
}
refresh();
)js"
