// The table of poses: one row is shown in the picture, any number of rows are ticked for copying.

class PoseTable {
  constructor(table, onShow, onClick, onTick) {
    this.table = table;
    this.body = table.tBodies[0];
    this.rows = [...this.body.rows];
    this.onShow = onShow;
    this.onClick = onClick;
    this.onTick = onTick;
    this.all = table.querySelector("thead input");
    this.body.addEventListener("click", (event) => this.clicked(event));
    this.body.addEventListener("change", () => this.ticked());
    this.body.addEventListener("keydown", (event) => this.pressed(event));
    this.all.addEventListener("change", () => this.tickAll(this.all.checked));
    for (const button of table.tHead.querySelectorAll("button")) {
      button.addEventListener("click", () => this.sort(button.closest("th")));
    }
  }

  numberOf(row) {
    return Number(row.dataset.pose);
  }

  boxOf(row) {
    return row.querySelector("input");
  }

  /** Numbers of the poses in the order of the rows, from top to bottom. */
  get order() {
    return this.rows.map((row) => this.numberOf(row));
  }

  get tickedNumbers() {
    return this.rows.filter((row) => this.boxOf(row).checked).map((row) => this.numberOf(row));
  }

  /** Marks the row of the pose that is drawn, and scrolls the table, not the page, so far that it is seen. */
  mark(number) {
    for (const row of this.rows) {
      const isShown = this.numberOf(row) === number;
      row.tabIndex = isShown ? 0 : -1;
      if (isShown) row.setAttribute("aria-current", "true");
      else row.removeAttribute("aria-current");
      if (isShown) this.reveal(row);
    }
  }

  reveal(row) {
    const view = this.table.parentElement;
    const [place, frame] = [row.getBoundingClientRect(), view.getBoundingClientRect()];
    const above = frame.top + this.table.tHead.offsetHeight - place.top;
    const below = place.bottom - frame.bottom;
    if (above > 0) view.scrollTop -= above;
    else if (below > 0) view.scrollTop += below + 2;
  }

  clicked(event) {
    const row = event.target.closest("tr");
    if (event.target.closest(".tick")) {
      if (event.target === this.boxOf(row)) return;
      this.boxOf(row).click();
      return;
    }
    this.onShow(this.numberOf(row));
    row.focus({ preventScroll: true });
    this.onClick();
  }

  pressed(event) {
    const row = event.target.closest("tr");
    const place = this.rows.indexOf(row);
    const last = this.rows.length - 1;
    const places = {
      ArrowDown: place + 1, ArrowUp: place - 1, PageDown: place + 10, PageUp: place - 10, Home: 0, End: last,
    };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in places) {
      const next = this.rows[clamp(places[event.key], 0, last)];
      this.onShow(this.numberOf(next));
      next.focus({ preventScroll: true });
      next.scrollIntoView({ block: "nearest" });
    } else if ((event.key === "Enter" || event.key === " ") && event.target === row) {
      this.boxOf(row).checked = !this.boxOf(row).checked;
      this.ticked();
    } else return;
    event.preventDefault();
  }

  tickAll(on) {
    for (const row of this.rows) this.boxOf(row).checked = on;
    this.ticked();
  }

  ticked() {
    for (const row of this.rows) row.setAttribute("aria-selected", String(this.boxOf(row).checked));
    const count = this.tickedNumbers.length;
    this.all.checked = count === this.rows.length;
    this.all.indeterminate = count > 0 && count < this.rows.length;
    this.onTick(count);
  }

  /** Rows in the order of a column; what has no value stands last, equal ones in the order of their numbers. */
  sort(header) {
    const falls = header.getAttribute("aria-sort") === "ascending";
    for (const other of header.parentElement.cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", falls ? "descending" : "ascending");
    const valueOf = (row) => row.cells[header.cellIndex].dataset.value;
    this.rows.sort((one, other) => {
      const [a, b] = [valueOf(one), valueOf(other)];
      if (a === "" || b === "") return Number(a === "") - Number(b === "") || this.numberOf(one) - this.numberOf(other);
      const difference = Number(a) === Number(b) ? 0 : Number(a) < Number(b) ? -1 : 1;
      return (falls ? -difference : difference) || this.numberOf(one) - this.numberOf(other);
    });
    this.body.append(...this.rows);
    announce(`Sorted by ${header.innerText.trim()}, ${falls ? "descending" : "ascending"}.`);
  }

  setAllDigits(on) {
    for (const cell of this.body.querySelectorAll("[data-full]")) {
      cell.dataset.short ??= cell.textContent;
      cell.textContent = on ? cell.dataset.full : cell.dataset.short;
    }
  }
}
