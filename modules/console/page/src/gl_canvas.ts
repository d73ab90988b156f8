// Draws triangles and lines of a certain width with WebGL: what a view of some walls and lines needs, and no more.

import { Mesh } from "./mesh";

const FACES = `
attribute vec3 place; attribute vec4 tint; uniform mat4 view; varying vec4 colour;
void main() { gl_Position = view * vec4(place, 1.0); colour = tint; }`;

// Every line is two triangles: each corner moves sideways on the screen. An end behind the eye is moved before it.
const LINES = `
attribute vec3 place; attribute vec3 other; attribute float side; attribute vec4 tint;
uniform mat4 view; uniform vec2 screen; uniform float width; varying vec4 colour;
const float NEAR = 0.05;
vec4 before(vec4 a, vec4 b) { return a.w < NEAR && b.w > NEAR ? mix(a, b, (NEAR - a.w) / (b.w - a.w)) : a; }
void main() {
  vec4 a = view * vec4(place, 1.0), b = view * vec4(other, 1.0);
  vec4 p = before(a, b), q = before(b, a);
  vec2 along = (q.xy / q.w - p.xy / p.w) * screen;
  vec2 across = normalize(vec2(-along.y, along.x) + vec2(1e-6, 0.0));
  p.xy += across * side * width / screen * p.w;
  gl_Position = p; colour = tint;
}`;

const PAINT = `
precision mediump float; varying vec4 colour;
void main() { gl_FragColor = vec4(colour.rgb * colour.a, colour.a); }`;

interface Program { program: WebGLProgram; buffer: WebGLBuffer; attributes: [string, number][]; stride: number }

export class GlCanvas {
  private readonly gl: WebGLRenderingContext;
  private readonly faces: Program;
  private readonly lines: Program;

  /** Throws when the browser has no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl", { antialias: true });
    if (gl === null) throw new Error("no WebGL");
    this.gl = gl;
    this.faces = this.build(FACES, [["place", 3], ["tint", 4]]);
    this.lines = this.build(LINES, [["place", 3], ["other", 3], ["side", 1], ["tint", 4]]);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Solid faces first, then lines, then what one sees through; `view` maps the map to the screen. */
  draw(view: Float32Array, solid: Mesh, lines: Mesh, clear: Mesh, width_px: number): void {
    const { gl, canvas } = this;
    const scale = window.devicePixelRatio;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * scale));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * scale));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.run(this.faces, view, solid.values);
    gl.useProgram(this.lines.program);
    gl.uniform2f(gl.getUniformLocation(this.lines.program, "screen"), canvas.width, canvas.height);
    gl.uniform1f(gl.getUniformLocation(this.lines.program, "width"), width_px * scale);
    this.run(this.lines, view, lines.values);
    gl.depthMask(false);
    this.run(this.faces, view, clear.values);
    gl.depthMask(true);
  }

  private build(vertex: string, attributes: [string, number][]): Program {
    const { gl } = this;
    const program = gl.createProgram(), buffer = gl.createBuffer();
    if (program === null || buffer === null) throw new Error("no WebGL");
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, PAINT]] as const) {
      const shader = gl.createShader(kind);
      if (shader === null) throw new Error("no WebGL");
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (gl.getProgramParameter(program, gl.LINK_STATUS) !== true) throw new Error(gl.getProgramInfoLog(program) ?? "");
    return { program, buffer, attributes, stride: attributes.reduce((sum, [, n]) => sum + n, 0) };
  }

  private run(use: Program, view: Float32Array, values: number[]): void {
    const { gl } = this;
    const bytes = Float32Array.BYTES_PER_ELEMENT;
    gl.useProgram(use.program);
    gl.uniformMatrix4fv(gl.getUniformLocation(use.program, "view"), false, view);
    gl.bindBuffer(gl.ARRAY_BUFFER, use.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(values), gl.DYNAMIC_DRAW);
    let at = 0;
    for (const [name, size] of use.attributes) {
      const place = gl.getAttribLocation(use.program, name);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, use.stride * bytes, at * bytes);
      at += size;
    }
    gl.drawArrays(gl.TRIANGLES, 0, values.length / use.stride);
  }
}
