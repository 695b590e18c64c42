// vtk_views/report/review.js: goes through the cases by keys, keeps grades, saves them as JSON.
"use strict";

class Review {
  constructor(root, names) {
    this.root = root;
    this.cases = names.map(name => ({case: name, grade: null, remark: ""}));
    this.index = 0;
    const on = (name, action) => root.querySelector(`[name=${name}]`).addEventListener("click", action);
    on("next", () => this.go(1));
    on("previous", () => this.go(-1));
    on("overlay", () => this.toggleModel());
    on("save", () => this.save());
    for (const button of root.querySelectorAll("[name=grade]"))
      button.addEventListener("click", () => this.grade(Number(button.value)));
    root.querySelector("[name=remark]").addEventListener("input", event => {
      this.cases[this.index].remark = event.target.value;
      this.showTable();
    });
    document.addEventListener("keydown", event => this.onKey(event));
    viewer?.root.addEventListener("case", event => {
      const chosen = this.cases.findIndex(entry => entry.case === event.detail);
      if (chosen >= 0) this.index = chosen;
      this.show();
    });
    this.show();
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (["INPUT", "SELECT", "TEXTAREA"].includes(event.target.tagName)) return;
    const actions = {n: () => this.go(1), p: () => this.go(-1), o: () => this.toggleModel(),
                     s: () => this.save()};
    for (const grade of [1, 2, 3, 4, 5]) actions[grade] = () => this.grade(grade);
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  go(step) {
    this.index = (this.index + step + this.cases.length) % this.cases.length;
    const map = viewer ? viewer.data.maps.findIndex(m => m.name === this.cases[this.index].case) : -1;
    if (map >= 0) viewer.selectMap(map);
    this.show();
  }

  toggleModel() {
    if (!viewer) return;
    viewer.style.model = !viewer.style.model;
    viewer.draw();
  }

  grade(value) {
    this.cases[this.index].grade = value;
    this.show();
  }

  // The hash is of the report's content, so that a review belongs to one report for good.
  text() {
    const value = name => this.root.querySelector(`[name=${name}]`).value.trim() || null;
    const metrics = JSON.parse(document.getElementById("metrics").textContent);
    return JSON.stringify({schema_version: 1, kind: "softscope_review",
                           report_sha256: metrics.content_sha256, reviewer: value("reviewer"),
                           decision: value("decision"), saved: new Date().toISOString(),
                           grades: this.cases}, null, 2);
  }

  save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.text()], {type: "application/json"}));
    link.download = "review.json";
    link.click();
    URL.revokeObjectURL(link.href);
  }

  show() {
    const now = this.cases[this.index];
    this.root.querySelector(".which").textContent = this.index + 1;
    this.root.querySelector(".name").textContent = now.case;
    this.root.querySelector("[name=remark]").value = now.remark;
    for (const button of this.root.querySelectorAll("[name=grade]"))
      button.setAttribute("aria-pressed", now.grade === Number(button.value));
    this.showTable();
  }

  showTable() {
    const rows = this.cases.map((entry, i) => {
      const row = document.createElement("tr");
      row.className = i === this.index ? "now" : "";
      for (const text of [entry.case, entry.grade ?? "\u2013", entry.remark])
        row.appendChild(document.createElement("td")).textContent = text;
      return row;
    });
    this.root.querySelector("tbody").replaceChildren(...rows);
  }
}

const review = (() => {
  const root = document.getElementById("review"), names = document.getElementById("cases");
  return root && names ? new Review(root, JSON.parse(names.textContent)) : null;
})();
