// Without it, the page is a sequence of slides.
const slides = [...document.querySelectorAll('.slide')];
const range = document.querySelector('#bar input');
const [back, on, all] = document.querySelectorAll('#bar button');
const root = document.documentElement;
let current = 0;
function show(index) {
  current = Math.max(0, Math.min(slides.length - 1, index));
  slides.forEach((slide, i) => slide.classList.toggle('current', i === current));
  range.value = current;
  back.disabled = current === 0;
  on.disabled = current === slides.length - 1;
  document.querySelector('#bar output').textContent = slides[current].dataset.title;
  if (root.classList.contains('single')) history.replaceState(null, '', '#' + slides[current].id);
  else slides[current].scrollIntoView();
}
function single(is) {
  root.classList.toggle('single', is);
  all.textContent = is ? 'all slides' : 'one slide';
  show(current);
}
range.max = slides.length - 1;
range.oninput = () => show(+range.value);
back.onclick = () => show(current - 1);
on.onclick = () => show(current + 1);
all.onclick = () => single(!root.classList.contains('single'));
addEventListener('keydown', event => {
  if (event.target === range || event.ctrlKey || event.altKey || event.metaKey) return;
  const to = { ArrowLeft: current - 1, ArrowRight: current + 1, Home: 0, End: slides.length - 1 }[event.key];
  if (to !== undefined) { show(to); event.preventDefault(); }
});
// A picture that is held shows the one before it.
for (const shown of document.querySelectorAll('.shown[data-before]')) {
  const image = shown.querySelector('img'), own = image.src;
  const before = document.querySelector(`#${shown.dataset.before} img`).src;
  shown.onpointerdown = event => { image.src = before; shown.setPointerCapture(event.pointerId); event.preventDefault(); };
  shown.onpointerup = shown.onpointercancel = () => { image.src = own; };
  shown.oncontextmenu = event => event.preventDefault();
}
root.classList.add('scripted');
const named = slides.findIndex(slide => '#' + slide.id === location.hash);
current = Math.max(0, named);
single(true);
