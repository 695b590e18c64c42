// vtk_views/report/error_map_gl.js: draws points or triangles in the colours of their errors (WebGL2).
"use strict";

const NO_ERROR = 65535;
const FLAG_OBSERVED = 1, FLAG_INSIDE = 2, FLAG_NO_SIDE = 4;

const VERTEX_SOURCE = `#version 300 es
layout(location = 0) in vec3 part;   // 0 to 1 inside the box
layout(location = 1) in float steps; // of the error; 65535 = none
layout(location = 2) in uint flags;
uniform vec3 low, size, centre;
uniform mat3 view;                   // rows: right, up, towards the viewer
uniform vec2 half_mm;                // what half of the picture spans
uniform float depth_mm, step_mm, point_px, push_mm;
uniform int is_signed, shown;        // shown: 0 all, 1 observed, 2 unseen
flat out float known;
out float value_mm, absolute_mm;
out vec3 seen_mm;
void main() {
  vec3 p = view * (low + part * size - centre);
  seen_mm = p;
  absolute_mm = steps * step_mm;
  bool inside = (flags & 2u) != 0u, no_side = (flags & 4u) != 0u, observed = (flags & 1u) != 0u;
  value_mm = is_signed == 1 && inside ? -absolute_mm : absolute_mm;
  bool right_part = shown == 0 || (shown == 1) == observed;
  known = steps > 65534.0 || (is_signed == 1 && no_side) || !right_part ? 0.0 : 1.0;
  gl_Position = vec4(p.xy / half_mm, -(p.z - push_mm) / depth_mm, 1.0);
  gl_PointSize = point_px;
}`;

// Colours are those of the bar: no lighting, but for the grey reference, which shows no value.
const FRAGMENT_SOURCE = `#version 300 es
precision highp float;
precision highp int;
flat in float known;
in float value_mm, absolute_mm;
in vec3 seen_mm;
uniform sampler2D palette;
uniform float limit_mm, above_mm, cone_depth;
uniform int is_signed, is_reference, is_points;
out vec4 colour;
void main() {
  float depth = gl_FragCoord.z;
  if (is_points == 1) {
    float r = length(gl_PointCoord - 0.5) * 2.0;
    if (r > 1.0) discard;
    depth += r * r * cone_depth;     // neighbours meet half-way
  }
  gl_FragDepth = depth;
  if (is_reference == 1) {
    vec3 n = normalize(cross(dFdx(seen_mm), dFdy(seen_mm)));
    colour = vec4(vec3(0.62 + 0.22 * abs(n.z)), 1.0);
    return;
  }
  if (above_mm > 0.0 && !(known > 0.5 && absolute_mm > above_mm)) discard;
  if (known < 0.5) { colour = vec4(0.55, 0.55, 0.55, 1.0); return; }
  float place = is_signed == 1 ? 0.5 + 0.5 * value_mm / limit_mm : value_mm / limit_mm;
  colour = vec4(texture(palette, vec2(clamp(place, 0.002, 0.998), 0.5)).rgb, 1.0);
}`;

/** The bytes of a base64 text as an array of `Type`. */
function decoded(text, Type) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Type(bytes.buffer);
}

/** What the GPU and picking need of one moment. */
function decodeMoment(moment, sameTriangles) {
  const out = {
    places: decoded(moment.places, Uint16Array), errors: decoded(moment.errors, Uint16Array),
    flags: decoded(moment.flags, Uint8Array),
    triangles: moment.triangles ? decoded(moment.triangles, Uint32Array) : null, reference: null};
  if (moment.reference) {
    out.reference = {places: decoded(moment.reference.places, Uint16Array),
      triangles: moment.reference.triangles ? decoded(moment.reference.triangles, Uint32Array)
                                            : sameTriangles};
  }
  return out;
}

/** One canvas that draws moments of one case at a time. Throws where WebGL2 is missing. */
class ErrorMapGl {
  constructor(canvas, palettes) {
    const gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error("WebGL2 is not available");
    this.gl = gl;
    this.program = this.link(VERTEX_SOURCE, FRAGMENT_SOURCE);
    this.palettes = {unsigned: this.paletteTexture(palettes.unsigned),
                     signed: this.paletteTexture(palettes.signed)};
    this.places = new Map();
    gl.enable(gl.DEPTH_TEST);
  }

  link(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
        throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  paletteTexture(text) {
    const gl = this.gl, texture = gl.createTexture(), bytes = decoded(text, Uint8Array);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, bytes.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, bytes);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
      gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    return texture;
  }

  buffer(target, values) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, values, gl.STATIC_DRAW);
  }

  /** A vertex array of places, and errors and flags where there are any. */
  upload(part) {
    const gl = this.gl, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    this.buffer(gl.ARRAY_BUFFER, part.places);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 6, 0);
    if (part.errors) {
      this.buffer(gl.ARRAY_BUFFER, part.errors);
      gl.enableVertexAttribArray(1);
      gl.vertexAttribPointer(1, 1, gl.UNSIGNED_SHORT, false, 2, 0);
      this.buffer(gl.ARRAY_BUFFER, part.flags);
      gl.enableVertexAttribArray(2);
      gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_BYTE, 1, 0);
    }
    gl.vertexAttribI4ui(2, 0, 0, 0, 0);  // for arrays without flags: of the shader's type
    if (part.triangles) this.buffer(gl.ELEMENT_ARRAY_BUFFER, part.triangles);
    gl.bindVertexArray(null);
    return {array, count: part.triangles ? part.triangles.length : part.places.length / 3,
            points: !part.triangles};
  }

  uploaded(moment) {
    if (!this.places.has(moment))
      this.places.set(moment, {model: this.upload(moment),
        reference: moment.reference ? this.upload(moment.reference) : null});
    return this.places.get(moment);
  }

  /** `look`: {view, centre, mmPerPx}; `style`: {signed, limit_mm, above_mm, shown, reference}. */
  draw(map, moment, look, style) {
    const gl = this.gl, canvas = gl.canvas, at = name => gl.getUniformLocation(this.program, name);
    const parts = this.uploaded(moment), depth = map.depth_mm;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    gl.uniform3fv(at("low"), map.low_mm);
    gl.uniform3fv(at("size"), map.size_mm);
    gl.uniform3fv(at("centre"), look.centre);
    gl.uniformMatrix3fv(at("view"), true, look.view.flat());
    gl.uniform2f(at("half_mm"), canvas.width / 2 * look.mmPerPx, canvas.height / 2 * look.mmPerPx);
    gl.uniform1f(at("depth_mm"), depth);
    gl.uniform1f(at("step_mm"), map.step_mm);
    const point = Math.max(map.point_mm / look.mmPerPx, 2);
    gl.uniform1f(at("point_px"), point);
    gl.uniform1f(at("cone_depth"), point * look.mmPerPx / 4 / depth);
    gl.uniform1f(at("limit_mm"), style.limit_mm);
    gl.uniform1f(at("above_mm"), style.above_mm);
    gl.uniform1i(at("is_signed"), style.signed ? 1 : 0);
    gl.uniform1i(at("shown"), style.shown);
    gl.bindTexture(gl.TEXTURE_2D, style.signed ? this.palettes.signed : this.palettes.unsigned);
    if (parts.reference && style.reference) this.drawPart(parts.reference, true, map, at);
    if (style.model) this.drawPart(parts.model, false, map, at);
  }

  drawPart(part, isReference, map, at) {
    const gl = this.gl;
    gl.uniform1i(at("is_reference"), isReference ? 1 : 0);
    gl.uniform1i(at("is_points"), part.points ? 1 : 0);
    gl.uniform1f(at("push_mm"), isReference ? map.push_mm : 0);
    gl.bindVertexArray(part.array);
    if (part.points) gl.drawArrays(gl.POINTS, 0, part.count);
    else gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }
}
