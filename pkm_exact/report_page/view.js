// The picture: base, platform and legs of one pose as SVG, turned by mouse, touch or keyboard.
// Points are moved and scaled so that all poses lie in the unit ball; d is the direction towards the viewer.

const SVG = "http://www.w3.org/2000/svg";
const PERSPECTIVE = 0.22;
const FREE = { azimuth: -60, elevation: 22, perspective: PERSPECTIVE };
const PRESETS = {
  reset: FREE,
  top: { azimuth: -90, elevation: 90, perspective: 0 },
  front: { azimuth: -90, elevation: 0, perspective: 0 },
  side: { azimuth: 0, elevation: 0, perspective: 0 },
};
const radians = (degrees) => (degrees * Math.PI) / 180;
const clamp = (value, least, most) => Math.min(most, Math.max(least, value));
const mean = (points) => [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);

function shape(name, attributes, text) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

/** Corners of the convex hull of points of the plane, in order: the outline of a body seen from the viewer. */
function outline(points) {
  const sorted = [...points].sort((p, q) => p.x - q.x || p.y - q.y);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return sorted.length < 2 ? sorted : [...half(sorted), ...half(sorted.reverse())];
}

/** The greatest of 1, 2 or 5 times a power of ten that is not above a value. */
function roundLength(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((factor) => factor * power <= value * 1.0000001) * power;
}

/** Centre and radius of a ball around the robot in all its poses. */
function surroundings(scene) {
  const points = scene.base.concat(...scene.poses.map((pose) => [
    ...pose.platform, ...pose.knees, ...pose.shapes.flatMap((shape) => shape.points),
  ]));
  const ends = [0, 1, 2].map((k) => [Math.min(...points.map((p) => p[k])), Math.max(...points.map((p) => p[k]))]);
  const centre = ends.map(([low, high]) => low + (high - low) / 2);
  return { points, centre, ends, radius: Math.max(...points.map((p) => distance(p, centre))) || 1 };
}

class View {
  constructor(host, scene) {
    this.host = host;
    this.scene = scene;
    this.svg = host.appendChild(shape("svg", { "aria-hidden": "true", focusable: "false" }));
    this.space = surroundings(scene);
    this.spacing = roundLength(this.space.radius / 2.5);
    this.index = 0;
    this.ghosts = false;
    this.camera = this.home("reset");
    new ResizeObserver(() => this.draw()).observe(host);
  }

  /** The camera of a standard view; reachX and reachY are how far the robot extends in it, in all its poses. */
  home(name) {
    const camera = { ...(this.scene.planar ? PRESETS.top : PRESETS[name]), zoom: 1, panX: 0, panY: 0 };
    const at = this.projected(camera, (depth) => 1 / (1 - camera.perspective * depth));
    const points = this.space.points.map(at);
    const reach = (key) => Math.max(0.05, ...points.map((p) => Math.abs(p[key])));
    return { ...camera, reachX: reach("x"), reachY: reach("y") };
  }

  show(index) {
    this.index = index;
    this.draw();
  }

  setGhosts(on) {
    this.ghosts = on;
    this.draw();
  }

  /** A standard view; the camera moves there, unless motion is unwanted. */
  preset(name) {
    const from = { ...this.camera };
    const to = this.home(name);
    from.azimuth -= 360 * Math.round((from.azimuth - to.azimuth) / 360);
    cancelAnimationFrame(this.frame);
    const start = performance.now();
    const step = (now) => {
      const t = matchMedia("(prefers-reduced-motion: reduce)").matches ? 1 : clamp((now - start) / 250, 0, 1);
      const eased = t * t * (3 - 2 * t);
      for (const key of Object.keys(to)) this.camera[key] = from[key] + (to[key] - from[key]) * eased;
      this.draw();
      if (t < 1) this.frame = requestAnimationFrame(step);
    };
    step(start);
  }

  turn(azimuth, elevation) {
    if (this.scene.planar) return;
    this.camera.azimuth += azimuth;
    this.camera.elevation = clamp(this.camera.elevation + elevation, -90, 90);
    this.camera.perspective = PERSPECTIVE;
    this.draw();
  }

  pan(x, y) {
    this.camera.panX += x;
    this.camera.panY += y;
    this.draw();
  }

  /** Zoom, so that the point of the picture at (x, y), from its centre, stays where it is. */
  zoom(factor, x = 0, y = 0) {
    const zoom = clamp(this.camera.zoom * factor, 0.2, 50);
    const done = zoom / this.camera.zoom;
    this.camera.zoom = zoom;
    this.camera.panX = x - (x - this.camera.panX) * done;
    this.camera.panY = y - (y - this.camera.panY) * done;
    this.draw();
  }

  /** To the right, upwards and towards the viewer, in units of the ball; nearer points are enlarged. */
  projected({ azimuth, elevation }, enlarged) {
    const [a, e] = [radians(azimuth), radians(elevation)];
    const d = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const right = [-Math.sin(a), Math.cos(a), 0];
    const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    const { centre, radius } = this.space;
    return (point) => {
      const p = point.map((x, k) => (x - centre[k]) / radius);
      const depth = dot(p, d);
      const near = enlarged(clamp(depth, -3, 3));
      return { x: near * dot(p, right), y: near * dot(p, up), depth };
    };
  }

  /** Where a point is drawn, and how near it is to the viewer. */
  projection(width, height) {
    const { perspective, zoom, panX, panY, reachX, reachY } = this.camera;
    const margin = 30;
    const scale = zoom * Math.min((width / 2 - margin) / reachX, (height / 2 - margin) / reachY);
    const at = this.projected(this.camera, (depth) => scale / (1 - perspective * depth));
    return (point) => {
      const { x, y, depth } = at(point);
      return { x: width / 2 + panX + x, y: height / 2 + panY - y, depth };
    };
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    const at = this.projection(width, height);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.dataset.pose = this.scene.poses[this.index].number;
    const ghosts = shape("g", { class: "ghost" });
    if (this.ghosts) {
      this.scene.poses.forEach((pose, i) => i !== this.index && ghosts.append(...this.robot(at, pose, true)));
    }
    const pose = this.scene.poses[this.index];
    this.svg.replaceChildren(
      ...this.grid(at), ghosts, ...this.axesAt(at, [0, 0, 0], null, 0.24), ...this.robot(at, pose, false),
      ...this.offset(at, pose), ...this.tags(at, pose),
    );
  }

  grid(at) {
    const [[x0, x1], [y0, y1]] = this.space.ends.slice(0, 2).map(([low, high]) => [
      Math.floor(low / this.spacing) * this.spacing,
      Math.ceil(high / this.spacing) * this.spacing,
    ]);
    const height = this.scene.planar ? 0 : mean(this.scene.base)[2];
    const steps = (low, high) => {
      const count = clamp(Math.round((high - low) / this.spacing), 0, 40);
      return Array.from({ length: count + 1 }, (_, k) => low + k * this.spacing);
    };
    return [
      ...steps(x0, x1).map((x) => this.line(at, "grid-line", [x, y0, height], [x, y1, height])),
      ...steps(y0, y1).map((y) => this.line(at, "grid-line", [x0, y, height], [x1, y, height])),
    ];
  }

  line(at, style, from, to) {
    const [p, q] = [at(from), at(to)];
    const digits = (value) => value.toFixed(2);
    return shape("line", { class: style, x1: digits(p.x), y1: digits(p.y), x2: digits(q.x), y2: digits(q.y) });
  }

  /** Bodies, legs and joints, those farther away first. */
  robot(at, pose, isGhost) {
    const feet = pose.knees.length ? pose.knees : this.scene.base;
    const items = [];
    const add = (node, ...points) => items.push([node, mean(points.map((p) => [at(p).depth, 0, 0]))[0]]);
    const body = (style, points) => {
      const corners = outline(points.map(at)).map((p) => `${p.x.toFixed(2)},${p.y.toFixed(2)}`).join(" ");
      add(shape("polygon", { class: `body ${style}`, points: corners }), ...points);
    };
    if (!isGhost) body("base", this.scene.base);
    body("platform", pose.platform);
    this.scene.legs.forEach(([a, b], i) => {
      const bar = this.scene.bars[i] || [0, 0, 0];
      const [joint, foot, held] = [this.scene.base[a], feet[a], pose.platform[b]];
      const end = held.map((value, k) => value + bar[k]);
      if (this.scene.bars.length && !isGhost) add(this.line(at, "leg bar", held, end), held, end);
      const chain = this.scene.chains[i];
      if (pose.knees.length && chain && !isGhost) add(this.line(at, `leg ${chain}`, joint, foot), joint, foot);
      add(this.line(at, `leg leg-${(i % 6) + 1}${this.scene.cables ? " cable" : ""}`, foot, end), foot, end);
    });
    if (!isGhost) {
      pose.shapes.forEach(({ number, kind, points }) => {
        points.slice(1).forEach((p, k) => {
          add(this.line(at, `leg leg-${((number - 1) % 6) + 1} shape ${kind}`, points[k], p), points[k], p);
        });
      });
    }
    if (!isGhost) {
      const joint = (style, p) => {
        const { x, y } = at(p);
        add(shape("circle", { class: `joint ${style}`, cx: x.toFixed(2), cy: y.toFixed(2), r: 4 }), p);
      };
      this.scene.base.forEach((p) => joint("base", p));
      pose.knees.filter((_, i) => this.scene.chains[i]).forEach((p) => joint("knee", p));
      pose.platform.forEach((p) => joint("platform", p));
    }
    return items.sort((one, other) => one[1] - other[1]).map(([node]) => node);
  }

  isNear(point) {
    return distance(point, this.space.centre) < 2 * this.space.radius;
  }

  /** Three axes; only if they are near the robot. */
  axesAt(at, origin, axes, size) {
    if (!this.isNear(origin)) return [];
    return ["x", "y", "z"].slice(0, this.scene.planar ? 2 : 3).flatMap((name, k) => {
      const axis = axes ? axes.map((row) => row[k]) : [0, 1, 2].map((i) => Number(i === k));
      const end = (length) => origin.map((value, i) => value + axis[i] * length * this.space.radius);
      const line = this.line(at, `axis axis-${name}`, origin, end(size));
      if (axes) return [line];
      const tip = at(end(size * 1.2));
      return [line, shape("text", { class: `tag axis-${name}`, x: tip.x.toFixed(2), y: tip.y.toFixed(2) }, name)];
    });
  }

  /** The frame of the platform, whose origin is the position in the table, and a line from there to the platform. */
  offset(at, pose) {
    if (!this.isNear(pose.origin)) return [];
    return [
      this.line(at, "offset", pose.origin, mean(pose.platform)), ...this.axesAt(at, pose.origin, pose.axes, 0.12),
    ];
  }

  /** Numbers of the legs beside their joints; those of joints at one place, or nearly so, together. */
  tags(at, pose) {
    const side = (points) => {
      const middle = at(mean(points));
      const groups = [];
      points.map(at).forEach((p, i) => {
        const group = groups.find((other) => Math.hypot(other.p.x - p.x, other.p.y - p.y) < 12);
        if (group) group.names.push(i + 1);
        else groups.push({ p, names: [i + 1] });
      });
      return groups.map(({ p, names }) => {
        const length = Math.hypot(p.x - middle.x, p.y - middle.y) || 1;
        const [x, y] = [p.x + (15 * (p.x - middle.x)) / length, p.y + (15 * (p.y - middle.y)) / length];
        return shape("text", { class: "tag", x: x.toFixed(2), y: y.toFixed(2) }, names.join("\u00b7"));
      });
    };
    return [...side(this.scene.base), ...side(pose.platform)];
  }
}
