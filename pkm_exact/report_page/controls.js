// The picture by hand: mouse, touch and keyboard.

/** Drag to turn, two fingers or the other button to move, wheel and pinch to zoom. */
function handlePointers(view) {
  const { host } = view;
  const fingers = new Map();
  const centred = (event) => {
    const box = host.getBoundingClientRect();
    return { x: event.clientX - box.left - box.width / 2, y: event.clientY - box.top - box.height / 2 };
  };
  const pair = () => {
    const [p, q] = [...fingers.values()];
    return { x: (p.x + q.x) / 2, y: (p.y + q.y) / 2, gap: Math.hypot(p.x - q.x, p.y - q.y) || 1 };
  };
  host.addEventListener("pointerdown", (event) => {
    host.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, centred(event));
    host.classList.add("held");
  });
  host.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = centred(event);
    const old = fingers.size === 2 ? pair() : null;
    fingers.set(event.pointerId, now);
    if (old) {
      const moved = pair();
      view.zoom(moved.gap / old.gap, moved.x, moved.y);
      view.pan(moved.x - old.x, moved.y - old.y);
    } else if (fingers.size === 1) {
      const moves = view.scene.planar || event.shiftKey || event.buttons > 1;
      if (moves) view.pan(now.x - before.x, now.y - before.y);
      else view.turn((before.x - now.x) * 0.5, (now.y - before.y) * 0.5);
    }
  });
  const release = (event) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) host.classList.remove("held");
  };
  host.addEventListener("pointerup", release);
  host.addEventListener("pointercancel", release);
  host.addEventListener("contextmenu", (event) => event.preventDefault());
  host.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    const { x, y } = centred(event);
    view.zoom(Math.exp(-clamp(event.deltaY * lines, -240, 240) * 0.0015), x, y);
  }, { passive: false });
}

function handleKeys(view, stepPose) {
  const turns = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10] };
  const others = {
    "+": () => view.zoom(1.25), "=": () => view.zoom(1.25), "-": () => view.zoom(0.8),
    0: () => view.preset("reset"), t: () => view.preset("top"), f: () => view.preset("front"),
    s: () => view.preset("side"), PageDown: () => stepPose(1), PageUp: () => stepPose(-1),
  };
  view.host.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turn = turns[event.key];
    const other = others[event.key] ?? others[event.key.toLowerCase()];
    if (turn && (view.scene.planar || event.shiftKey)) view.pan(turn[0] * 3, -turn[1] * 3);
    else if (turn) view.turn(...turn);
    else if (other) other();
    else return;
    event.preventDefault();
  });
}
