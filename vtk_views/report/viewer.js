// vtk_views/report/viewer.js: turns, zooms, clips, plays and picks the error map of a report.
"use strict";

/** Rows right, up, towards the viewer, for one who looks along `look`. */
function viewAlong(look, up) {
  const back = normalised(look.map(x => -x));
  const right = normalised(cross(up, back));
  return [right, cross(back, right), back];
}
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const normalised = a => { const n = Math.hypot(...a) || 1; return a.map(x => x / n); };

/** `view` turned by angles about the picture's own right and up axes. */
function turned(view, rightRad, upRad) {
  const [c, s] = [Math.cos(upRad), Math.sin(upRad)], [d, t] = [Math.cos(rightRad), Math.sin(rightRad)];
  const [x, y, z] = view;
  const x1 = x.map((v, i) => c * v - s * z[i]), z1 = z.map((v, i) => s * x[i] + c * v);
  return [x1, y.map((v, i) => d * v - t * z1[i]), z1.map((v, i) => t * y[i] + d * v)];
}

class Viewer {
  constructor(root, data) {
    this.root = root;
    this.data = data;
    this.canvas = root.querySelector("canvas");
    this.gl = new ErrorMapGl(this.canvas, data.palettes);
    this.moments = data.maps.map(() => []);
    this.style = {signed: false, limit_mm: data.limit_mm, above_mm: 0, shown: 0, reference: true,
                  model: true};
    this.picked = null;
    root.classList.add("live");  // the canvas takes the picture's place, and has its size from now on
    this.bindControls();
    this.bindPointer();
    this.selectMap(0);
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  control(name) { return this.root.querySelector(`[name=${name}]`); }

  bindControls() {
    const listen = (name, event, action) => {
      const control = this.control(name);
      control.addEventListener(event, () => { action(control); this.draw(); });
    };
    listen("kind", "change", c => { this.style.signed = c.value === "signed"; });
    listen("limit", "input", c => { this.style.limit_mm = Number(c.value); });
    listen("above", "input", c => { this.style.above_mm = Number(c.value); });
    listen("shown", "change", c => { this.style.shown = Number(c.value); });
    listen("reference", "change", c => { this.style.reference = c.checked; });
    listen("time", "input", c => this.selectMoment(Number(c.value)));
    listen("case", "change", c => this.selectMap(Number(c.value)));
    listen("home", "click", () => this.resetView());
    listen("play", "click", () => this.togglePlay());
    // Stray points far off would leave no room on the slider for what matters.
    const end = Math.min(this.data.largest_mm, 10 * this.data.limit_mm);
    for (const name of ["limit", "above"]) {
      this.control(name).max = end;
      this.control(name).step = end / 200;
    }
    this.control("limit").min = end / 200;
    this.data.maps.forEach((map, i) => this.control("case").add(new Option(map.name, i)));
    this.root.querySelector(".only-cases").hidden = this.data.maps.length < 2;
  }

  bindPointer() {
    let last = null, moved = 0;
    const canvas = this.canvas;
    canvas.addEventListener("pointerdown", e => {
      canvas.setPointerCapture(e.pointerId);
      last = [e.clientX, e.clientY];
      moved = 0;
    });
    canvas.addEventListener("pointermove", e => {
      if (!last) return;
      const [dx, dy] = [e.clientX - last[0], e.clientY - last[1]];
      last = [e.clientX, e.clientY];
      moved += Math.abs(dx) + Math.abs(dy);
      if (e.shiftKey || e.buttons === 2 || e.buttons === 4) this.pan(dx, dy);
      else this.turn(dy * 0.008, dx * 0.008);
    });
    canvas.addEventListener("pointerup", e => {
      if (last && moved < 4) this.pick(e.offsetX, e.offsetY);
      last = null;
    });
    canvas.addEventListener("contextmenu", e => e.preventDefault());
    canvas.addEventListener("wheel", e => {
      e.preventDefault();
      this.zoom(Math.exp(e.deltaY * 0.001));
    }, {passive: false});
    canvas.addEventListener("keydown", e => this.onKey(e));
  }

  onKey(event) {
    const step = 0.1;
    const actions = {
      ArrowLeft: () => this.turn(0, -step), ArrowRight: () => this.turn(0, step),
      ArrowUp: () => this.turn(-step, 0), ArrowDown: () => this.turn(step, 0),
      "+": () => this.zoom(0.9), "-": () => this.zoom(1 / 0.9), Home: () => this.resetView()};
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
    this.draw();
  }

  turn(rightRad, upRad) { this.look.view = turned(this.look.view, rightRad, upRad); this.draw(); }
  zoom(factor) {
    const widest = 8 * Math.max(...this.map.half_mm) / this.canvas.clientHeight;
    this.look.mmPerPxCss = Math.min(Math.max(this.look.mmPerPxCss * factor, widest / 4000), widest);
    this.draw();
  }
  pan(dx, dy) {
    const [right, up] = this.look.view, s = this.look.mmPerPxCss;
    this.look.centre = this.look.centre.map((v, i) => v - right[i] * dx * s + up[i] * dy * s);
    this.draw();
  }

  selectMap(index) {
    this.index = index;
    this.map = this.data.maps[index];
    this.root.dispatchEvent(new CustomEvent("case", {detail: this.map.name}));
    this.control("case").value = index;
    const time = this.control("time");
    time.max = this.map.moments.length - 1;
    this.root.querySelector(".only-series").hidden = this.map.moments.length < 2;
    this.control("shown").closest("label").hidden = !this.map.has_observed;
    this.control("reference").closest("label").hidden = !this.map.moments[0].reference;
    this.root.querySelector(".grey-reference").hidden = !this.map.moments[0].reference;
    this.selectMoment(this.map.moments.length - 1);
    this.resetView();
  }

  selectMoment(index) {
    this.moment_index = index;
    this.control("time").value = index;
    this.picked = null;
    const known = this.moments[this.index];
    if (!known[index]) {
      const first = this.map.moments[0].reference;
      this.same ??= new Map();
      if (first && !this.same.has(this.map))
        this.same.set(this.map, decoded(first.triangles, Uint32Array));
      known[index] = decodeMoment(this.map.moments[index], this.same.get(this.map));
    }
    this.moment = known[index];
    this.root.querySelector(".moment").textContent = this.map.moments[index].label;
  }

  resetView() {
    const [wide, high] = this.map.half_mm, canvas = this.canvas;
    this.look = {view: viewAlong(this.map.look, this.map.up), centre: [...this.map.centre_mm],
                 mmPerPxCss: 2.15 * Math.max(wide / Math.max(canvas.clientWidth, 50),
                                             high / Math.max(canvas.clientHeight, 50))};
    this.draw();
  }

  togglePlay() {
    if (this.playing) { clearInterval(this.playing); this.playing = null; }
    else this.playing = setInterval(() => {
      this.selectMoment((this.moment_index + 1) % this.map.moments.length);
      this.draw();
    }, 300);
    this.control("play").textContent = this.playing ? "Pause" : "Play";
  }

  draw() {
    if (!this.look) return;
    const ratio = window.devicePixelRatio || 1, canvas = this.canvas;
    const [w, h] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (w === 0 || h === 0) return;
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    this.gl.draw(this.map, this.moment, {...this.look, mmPerPx: this.look.mmPerPxCss / ratio},
                 this.style);
    this.drawBar();
    this.showMark();
    this.showSides();
    this.showRuler();
    this.control("limit").value = this.style.limit_mm;
    this.root.querySelector(".limit-value").textContent = millimetres(this.style.limit_mm);
    this.root.querySelector(".above-value").textContent =
      this.style.above_mm > 0 ? "> " + millimetres(this.style.above_mm) : "off";
  }

  drawBar() {
    const palette = decoded(this.data.palettes[this.style.signed ? "signed" : "unsigned"], Uint8Array);
    const stops = [];
    for (let i = 0; i < 256; i += 15) stops.push(`rgb(${palette.subarray(3 * i, 3 * i + 3).join()})`);
    const limit = this.style.limit_mm, bar = this.root.querySelector(".bar");
    bar.querySelector(".ramp").style.background = `linear-gradient(to top, ${stops.join()})`;
    const values = this.style.signed ? [-1, -0.5, 0, 0.5, 1] : [0, 0.25, 0.5, 0.75, 1];
    bar.querySelectorAll(".number").forEach((label, i) => {
      const beyond = this.data.largest_mm > limit * 1.0001 &&
          (values[i] === 1 || values[i] === -1) ? (values[i] > 0 ? "\u2265 " : "\u2264 ") : "";
      label.textContent = beyond + Number((values[i] * limit).toPrecision(3));
    });
    bar.querySelector(".title").textContent =
      this.style.signed ? "signed distance [mm], + = outside" : "distance [mm]";
  }

  /** Letters of a patient's sides at the picture's edges; nothing where the space isn't known. */
  showSides() {
    const [right, up] = this.look.view, minus = v => v.map(x => -x);
    const at = {left: minus(right), right, top: up, bottom: minus(up)};
    for (const [edge, direction] of Object.entries(at))
      this.root.querySelector(".side." + edge).textContent = sideName(direction, this.map.space);
  }

  /** The longest of 1, 2, 5, 10, ... mm that takes at most a quarter of the picture's width. */
  showRuler() {
    const most = this.canvas.clientWidth / 4 * this.look.mmPerPxCss;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].find(leading => leading * power <= most) * power;
    const ruler = this.root.querySelector(".ruler");
    ruler.querySelector("i").style.width = length / this.look.mmPerPxCss + "px";
    ruler.querySelector("span").textContent = Number(length.toPrecision(1)) + " mm";
  }

  position(i) {
    const {low_mm: low, size_mm: size} = this.map, p = this.moment.places;
    return [0, 1, 2].map(k => low[k] + p[3 * i + k] / 65535 * size[k]);
  }

  /** Right, up, towards the viewer, in mm from the picture's centre. */
  project(p) {
    const d = p.map((v, k) => v - this.look.centre[k]);
    return this.look.view.map(row => dot(row, d));
  }

  isShown(i) {
    const m = this.moment, seen = (m.flags[i] & FLAG_OBSERVED) !== 0, e = m.errors[i];
    if (this.style.shown !== 0 && (this.style.shown === 1) !== seen) return false;
    return this.style.above_mm <= 0 ||
        (e !== NO_ERROR && e * this.map.step_mm > this.style.above_mm);
  }

  pick(x, y) {
    const at = [(x - this.canvas.clientWidth / 2) * this.look.mmPerPxCss,
                (this.canvas.clientHeight / 2 - y) * this.look.mmPerPxCss];
    this.picked = this.moment.triangles ? this.pickTriangle(at) : this.pickPoint(at);
    this.draw();
  }

  /** Of the points whose disc lies under the pointer, the one in front. */
  pickPoint(at) {
    const reach = Math.max(this.map.point_mm / 2, 4 * this.look.mmPerPxCss);
    let best = null;
    for (let i = 0; i < this.moment.errors.length; ++i) {
      if (!this.isShown(i)) continue;
      const p = this.project(this.position(i)), off = Math.hypot(p[0] - at[0], p[1] - at[1]);
      if (off > reach) continue;
      const rank = p[2] - 2 * off;  // in front, and near to the pointer
      if (!best || rank > best.rank) best = {rank, i};
    }
    return best && this.reading(this.position(best.i), best.i);
  }

  /** The vertex nearest to where the line of sight meets the frontmost triangle. */
  pickTriangle(at) {
    const count = this.moment.errors.length, seen = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) seen.set(this.project(this.position(i)), 3 * i);
    const t = this.moment.triangles;
    let best = null;
    for (let k = 0; k < t.length; k += 3) {
      const w = weightsIn(at, seen, t[k], t[k + 1], t[k + 2]);
      if (!w) continue;
      const z = w[0] * seen[3 * t[k] + 2] + w[1] * seen[3 * t[k + 1] + 2] + w[2] * seen[3 * t[k + 2] + 2];
      const corner = t[k + w.indexOf(Math.max(...w))];
      if (this.isShown(corner) && (!best || z > best.z)) best = {z, corner};
    }
    return best && this.reading(this.position(best.corner), best.corner);
  }

  reading(place, i) {
    const m = this.moment, e = m.errors[i], sign = m.flags[i] & FLAG_INSIDE ? "inside" : "outside";
    const side = m.flags[i] & FLAG_NO_SIDE ? "at the reference's border" : sign + " the reference";
    const seen = !this.map.has_observed ? "" :
        m.flags[i] & FLAG_OBSERVED ? "; seen now" : "; not seen now, predicted";
    const distance = e === NO_ERROR ? "no distance" :
        (e * this.map.step_mm).toFixed(3) + " mm, " + side + seen;
    const text = place.map(v => v.toFixed(2)).join(", ");
    return {place, text: `${distance}\nx, y, z = ${text} mm (${this.map.space})`};
  }

  showMark() {
    const mark = this.root.querySelector(".mark"), text = this.root.querySelector(".reading");
    mark.hidden = !this.picked;
    text.textContent = this.picked ? this.picked.text :
        "Click on the surface: its distance and place are told here.";
    if (!this.picked) return;
    const p = this.project(this.picked.place);
    mark.style.left = this.canvas.clientWidth / 2 + p[0] / this.look.mmPerPxCss + "px";
    mark.style.top = this.canvas.clientHeight / 2 - p[1] / this.look.mmPerPxCss + "px";
  }
}

/** One to three of R L A P S I, the strongest first. */
function sideName(direction, space) {
  const letters = {LPS: ["RL", "AP", "IS"], RAS: ["LR", "PA", "IS"]}[space];
  if (!letters) return "";
  return direction.map((v, k) => [Math.abs(v), letters[k][v > 0 ? 1 : 0]])
      .filter(([size]) => size > 0.3).sort((a, b) => b[0] - a[0]).map(([, letter]) => letter).join("");
}

const millimetres = value => value.toFixed(value < 1 ? 3 : 2) + " mm";

/** Barycentric weights of `at` in a projected triangle, or null outside. */
function weightsIn(at, seen, a, b, c) {
  const [ax, ay, bx, by] = [seen[3 * a], seen[3 * a + 1], seen[3 * b], seen[3 * b + 1]];
  const [cx, cy] = [seen[3 * c], seen[3 * c + 1]];
  const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  if (area === 0) return null;
  const v = ((at[0] - ax) * (cy - ay) - (at[1] - ay) * (cx - ax)) / area;
  const w = ((bx - ax) * (at[1] - ay) - (by - ay) * (at[0] - ax)) / area;
  return v < 0 || w < 0 || v + w > 1 ? null : [1 - v - w, v, w];
}

/** The page's viewer, or null where there is no map or nothing that draws it: then the picture stays. */
const viewer = (() => {
  const root = document.getElementById("viewer"), data = document.getElementById("maps");
  if (!root || !data) return null;
  try {
    return new Viewer(root, JSON.parse(data.textContent));
  } catch (error) {
    root.classList.remove("live");
    root.querySelector(".no-webgl").textContent =
      "The map can't be turned here (" + error.message + "): this is its picture.";
    return null;
  }
})();
