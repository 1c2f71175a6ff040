// Joins table, picture and numbers of the pose that is shown. All data are in the page; nothing is loaded or sent.

const byId = (id) => document.getElementById(id);
const announce = (text) => { byId("announcement").textContent = text; };

function make(name, text, attributes = {}) {
  const node = document.createElement(name);
  if (text !== null) node.textContent = text;
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  return node;
}

function tableRow(cells, heading) {
  const row = make("tr", null);
  row.append(make("th", heading, { scope: "row" }), ...cells.map((cell) => make("td", cell)));
  return row;
}

/** A pose by its number, which is not its place in the list if others are not listed. */
function named(data, number) {
  const count = data.poses.length;
  return data.poses.some((pose) => pose.number > count) ? `Pose ${number} (listed: ${count})` : `Pose ${number} of ${count}`;
}

/** Position, quaternion, matrix and exact box of one pose. */
function showNumbers(data, pose) {
  byId("pose-title").textContent = named(data, pose.number);
  const lines = pose.lines.flatMap(([name, value]) => [make("dt", name), make("dd", value, { class: "number" })]);
  byId("pose-lines").replaceChildren(...lines);
  byId("pose-matrix").replaceChildren(...pose.rotation.map((row, i) => tableRow(row, `row ${i + 1}`)));
  byId("pose-box").replaceChildren(...pose.bounds.map(([name, low, high]) => tableRow([low, high], name)));
}

const quoted = (text) => (/[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const csv = (rows) => rows.map((row) => row.map((cell) => quoted(String(cell))).join(",") + "\n").join("");

const LAYOUTS = {
  csv: (data, poses) => csv([data.columns, ...poses.map((pose) => pose.cells)]),
  exact: (data, poses) => csv([
    [...data.exact_first, ...data.poses[0].bounds.flatMap(([name]) => [`${name}_lo`, `${name}_hi`])],
    ...poses.map((pose) => [...pose.exact_first, ...pose.bounds.flatMap(([, low, high]) => [low, high])]),
  ]),
  quaternion: (data, poses) => {
    const numbers = (list) => `[${list.join(", ")}]`;
    const lines = poses.map((pose) =>
      `{"pose": ${pose.number}, "position": ${numbers(pose.position)}, "quaternion": ${numbers(pose.quaternion)}}`);
    return `[${lines.join(",\n ")}]\n`;
  },
};

/** To the clipboard, or, where the browser does not allow it, into a field from which it can be taken. */
async function copy(text, count) {
  const what = count === 1 ? "1 pose" : `${count} poses`;
  const [place, field] = [byId("copied"), byId("copied-text")];
  field.value = text;
  place.hidden = false;
  try {
    await navigator.clipboard.writeText(text);
    announce(`Copied ${what}. The text also stands below the buttons.`);
    byId("copied-label").textContent = `Copied to the clipboard: ${what}`;
  } catch {
    field.focus();
    field.select();
    announce(`The clipboard is not available: ${what} selected in a field, press Control or Command and C.`);
    byId("copied-label").textContent = `The clipboard is not available here: press Ctrl+C or Cmd+C to copy ${what}`;
  }
}

function startThemeButton() {
  const button = byId("theme");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => (document.documentElement.dataset.theme ?? (dark.matches ? "dark" : "light")) === "dark";
  const update = () => button.setAttribute("aria-pressed", String(isDark()));
  button.addEventListener("click", () => {
    document.documentElement.dataset.theme = isDark() ? "light" : "dark";
    update();
  });
  dark.addEventListener("change", update);
  button.hidden = false;
  update();
}

/** Scrolls the page to the picture unless most of it is seen: on a small screen the table is below it. */
function reveal(node) {
  const box = node.getBoundingClientRect();
  const seen = Math.min(box.bottom, innerHeight) - Math.max(box.top, 0);
  if (seen < 0.8 * box.height) node.scrollIntoView({ block: "center" });
}

function startPoses(data) {
  const view = new View(byId("view"), data);
  const withNumber = new Map(data.poses.map((pose, index) => [pose.number, index]));
  let shown = data.first_shown ?? data.poses[0].number;
  const show = (number) => {
    shown = number;
    const pose = data.poses[withNumber.get(number)];
    view.show(withNumber.get(number));
    table.mark(number);
    showNumbers(data, pose);
    const meant = number === data.first_shown ? ", nearest to the one that is meant" : "";
    byId("view-corner").textContent = `Pose ${number}${meant}`;
  };
  const choose = (number) => {
    show(number);
    announce(`${named(data, number)} is shown. ${data.poses[withNumber.get(number)].summary}`);
  };
  const step = (by) => {
    const place = table.order.indexOf(shown) + by;
    choose(table.order[(place + table.order.length) % table.order.length]);
  };
  const table = new PoseTable(byId("pose-table"), choose, () => reveal(byId("view")), (count) => {
    byId("ticked").textContent = count ? `${count} ticked` : `none ticked: all ${data.poses.length}`;
  });
  show(shown);
  handlePointers(view);
  handleKeys(view, step);
  byId("view-caption").textContent = `grid ${Number(view.spacing.toPrecision(1))}${data.unit}`;
  byId("previous").addEventListener("click", () => step(-1));
  byId("next").addEventListener("click", () => step(1));
  for (const button of document.querySelectorAll("[data-preset]")) {
    button.addEventListener("click", () => view.preset(button.dataset.preset));
  }
  const toggle = (button, action) => button?.addEventListener("click", () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    action(on);
  });
  toggle(byId("ghosts"), (on) => view.setGhosts(on));
  toggle(byId("digits"), (on) => table.setAllDigits(on));
  for (const button of document.querySelectorAll("[data-copy]")) {
    button.addEventListener("click", () => {
      const ticked = new Set(table.tickedNumbers);
      const numbers = table.order.filter((number) => !ticked.size || ticked.has(number));
      copy(LAYOUTS[button.dataset.copy](data, numbers.map((number) => data.poses[withNumber.get(number)])), numbers.length);
    });
  }
}

startThemeButton();
const data = JSON.parse(byId("data").textContent);
if (data.poses.length) startPoses(data);
