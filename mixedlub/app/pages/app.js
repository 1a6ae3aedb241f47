"use strict";
const LARGEST = 50 * 2 ** 20;
// A file that is dropped or chosen is sent at once, unless it is too large.
for (const input of document.querySelectorAll("input[data-send]")) {
  const zone = input.closest(".drop");
  for (const [event, on] of [["dragenter", true], ["dragleave", false], ["drop", false]])
    input.addEventListener(event, () => zone.classList.toggle("over", on));
  input.addEventListener("change", () => {
    const size = Array.from(input.files).reduce((sum, file) => sum + file.size, 0);
    const told = zone.querySelector("span");
    if (size > LARGEST) {
      told.textContent = "The files are larger than 50 MB together; send fewer, or average them first.";
      input.value = "";
    } else if (size || input.files.length) {
      told.textContent = "sending and reading ...";
      input.form.requestSubmit();
    }
  });
}
// A choice that changes the other questions is sent at once.
for (const input of document.querySelectorAll("[data-now]"))
  input.addEventListener("change", () => input.form.requestSubmit(input.form.querySelector("[name=do][value=update]")));
// A form that computes is sent once.
for (const form of document.querySelectorAll("form"))
  form.addEventListener("submit", (event) => {
    if (form.dataset.sent) event.preventDefault();
    form.dataset.sent = "yes";
  });
// The state of a run is asked for until it is over.
const run = document.querySelector("[data-job]");
async function follow() {
  try {
    const answer = await fetch(run.dataset.job);
    const job = await answer.json();
    if (job.state !== "waiting" && job.state !== "running") { location.reload(); return; }
    run.querySelector(".state").textContent = job.state;
    run.querySelector(".state").className = "state " + job.state;
    run.querySelector(".text").textContent = job.text;
    run.querySelector(".seconds").textContent = Math.round(job.seconds) + " s";
    const bar = run.querySelector("progress");
    if (job.of) { bar.max = job.of; bar.value = job.done; } else bar.removeAttribute("value");
  } catch (error) { run.querySelector(".text").textContent = "the page has been closed at its terminal"; }
  setTimeout(follow, 700);
}
if (run) setTimeout(follow, 300);
