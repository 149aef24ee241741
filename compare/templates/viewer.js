'use strict';
// Exact and approximate images on one canvas: flips, splits, exposure, error modes, zoom,
// values under the pointer. State lives in the address (#v=...). Places are pixels of the
// image files, also while the page holds means of several pixels.
(() => {
  const contents = JSON.parse(document.getElementById('viewer-data').textContent);
  const byId = (id) => document.getElementById(id);
  const canvas = byId('v-canvas');
  const picture = snellPicture(canvas, contents.ramps);
  if (!picture) return;
  byId('viewer').hidden = false;

  const MODES = ['radiance', 'difference', 'relative', 'flip', 'angle'];
  // scene: place in contents; image, left: 0 is the exact one; split: 0..1, where
  // images left of it come from `left`; x, y: centre in pixels; zoom: 1 = whole.
  const state = { scene: 0, image: 1, left: 0, split: 0.5, mode: 0, ev: 0, x: 0, y: 0, zoom: 1 };
  const sceneNow = () => contents.scenes[state.scene];
  // Pixels of the file along a side of what is held of it.
  const texelOf = (scene) => (scene.full ? 1 : scene.texel_px);

  // Data in full size lie beside the page, in a script per scene that calls this.
  window.snellScene = (index, blocks) => {
    const scene = contents.scenes.find((one) => one.index === index);
    scene.full = blocks;
    if (scene === sceneNow()) draw();
  };
  function wantFull(scene) {
    if (!scene.file || scene.asked) return;
    scene.asked = true;
    const script = document.createElement('script');
    script.src = scene.file;
    script.onerror = () => { scene.missing = true; inspect(); };
    document.head.append(script);
  }

  const decoded = new Map();
  function get(scene, image, kind) {
    const texel = texelOf(scene), key = `${scene.index}-${image}-${kind}`;
    if (!decoded.has(`${texel}:${key}`)) {
      const element = byId(`data-${key}`), text = scene.full ? scene.full[key] : element && element.textContent;
      const size = [scene.width, scene.height].map((side) => Math.ceil(side / texel));
      decoded.set(`${texel}:${key}`, text ? picture.decode(text, ...size, kind === 'radiance' ? 3 : 1) : null);
    }
    return decoded.get(`${texel}:${key}`);
  }

  let ready = null;
  let drawing = 0;
  const scaleNow = () => state.zoom * canvas.width / sceneNow().width;
  async function draw() {
    const turn = ++drawing, scene = sceneNow(), texel_px = texelOf(scene);
    const kind = MODES[state.mode], map = kind === 'flip' || kind === 'angle' ? kind : null;
    const [exact, right, left, rightMap, leftMap, flip, angle] = await Promise.all([
      get(scene, 0, 'radiance'), get(scene, state.image, 'radiance'), get(scene, state.left, 'radiance'),
      map && get(scene, state.image, map), map && get(scene, state.left, map),
      get(scene, state.image, 'flip'), get(scene, state.image, 'angle')]);
    if (turn !== drawing) return;
    ready = { scene, texel_px, exact, right, left, flip, angle };
    const width = canvas.clientWidth, ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(width * ratio * Math.min(1, scene.height / scene.width));
    canvas.style.aspectRatio = `${canvas.width} / ${canvas.height}`;
    picture.draw({ exact, right, left, rightMap, leftMap }, {
      centre_px: [state.x, state.y], size_px: [scene.width, scene.height], zoom_px: scaleNow(), texel_px,
      split_px: state.split * canvas.width, ev: state.ev, mode: state.mode });
    canvas.dataset.drawn = turn;
    canvas.dataset.texel = texel_px;
    inspect();
    histogram();
  }

  function controls() {
    const scene = sceneNow();
    byId('v-scene').value = state.scene;
    byId('v-left').replaceChildren(...scene.images.map((name, i) => new Option(name, i)));
    byId('v-left').value = state.left;
    byId('v-images').replaceChildren(...scene.images.map((name, i) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = `${i + 1} ${name}`;
      button.setAttribute('aria-pressed', String(i === state.image));
      button.addEventListener('click', () => update({ image: i }));
      return button;
    }));
    byId('v-left-name').textContent = scene.images[state.left];
    byId('v-left-name').hidden = !(state.split > 0);
    byId('v-right-name').textContent = scene.images[state.image];
    byId('v-facts').replaceChildren(...scene.facts[state.image].map(([name, value]) => {
      const row = document.createElement('tr'), head = document.createElement('th'), cell = document.createElement('td');
      head.textContent = name;
      cell.textContent = value;
      cell.className = 'n';
      row.append(head, cell);
      return row;
    }));
    byId('v-mode').value = state.mode;
    byId('v-ev').value = state.ev;
    byId('v-ev-text').textContent = `${state.ev > 0 ? '+' : ''}${state.ev} stops`;
  }

  const address = () => {
    const s = state, short = (v) => String(Math.round(v * 1000) / 1000);
    return `#v=${sceneNow().index}.${s.image}.${MODES[s.mode]}&left=${s.left}&split=${short(s.split)}` +
      `&ev=${short(s.ev)}&x=${short(s.x)}&y=${short(s.y)}&zoom=${short(s.zoom)}`;
  };
  let quiet = false;
  function update(change, keepAddress) {
    Object.assign(state, change);
    const scene = sceneNow(), last = scene.images.length - 1;
    state.image = Math.min(state.image, last);
    state.left = Math.min(state.left, last);
    wantFull(scene);
    controls();
    if (!keepAddress) { quiet = true; history.replaceState(null, '', address()); quiet = false; }
    draw();
  }
  function choose(place, more) {
    const scene = contents.scenes[place];
    update({ scene: place, image: scene.best, left: 0, ev: scene.ev, x: scene.width / 2, y: scene.height / 2, zoom: 1, ...more }, !more);
  }
  // #v=scene.image[.mode] with optional &name=value; anything else is a plain anchor.
  function restore() {
    if (quiet || !location.hash.startsWith('#v=')) return false;
    const parts = new URLSearchParams(location.hash.slice(1));
    const [index, image, mode] = parts.get('v').split('.');
    const place = contents.scenes.findIndex((scene) => scene.index === Number(index));
    if (place < 0) return false;
    const more = { image: Number(image) || 0, mode: Math.max(0, MODES.indexOf(mode)) };
    for (const name of ['left', 'split', 'ev', 'x', 'y', 'zoom']) {
      const value = Number(parts.get(name));
      if (parts.has(name) && Number.isFinite(value)) more[name] = value;
    }
    choose(place, more);
    byId('viewer').scrollIntoView();
    return true;
  }

  // Where the pointer was last, in canvas pixels: what is told of it follows a change of image.
  let pointed = null;
  const point = (event) => {
    const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width;
    return [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio];
  };
  const pixelAt = ([x, y]) => [(x - canvas.width / 2) / scaleNow() + state.x, (y - canvas.height / 2) / scaleNow() + state.y];
  function place(x, y, scene, texel) {
    if (texel === 1) return `pixel ${x}, ${y}`;
    const span = (from, side) => `${from} to ${Math.min(from + texel, side) - 1}`;
    const why = scene.missing ? `, ${scene.file} is not there` : '';
    return `pixels ${span(x, scene.width)}, ${span(y, scene.height)} (their mean${why})`;
  }
  function inspect() {
    if (!ready || !pointed || ready.scene !== sceneNow()) return;
    const { scene, texel_px, exact, right, left, flip, angle } = ready;
    const [x, y] = pixelAt(pointed).map((at) => Math.floor(at / texel_px));
    if (x < 0 || y < 0 || x * texel_px >= scene.width || y * texel_px >= scene.height) return;
    const at = y * Math.ceil(scene.width / texel_px) + x;
    const one = (it) => picture.half(it.bits[at]), three = (it) => [0, 1, 2].map((c) => picture.half(it.bits[3 * at + c]));
    const show = (values) => values.map((v) => v.toPrecision(4).padStart(11)).join(' ');
    const line = (name, values) => `${name.slice(0, 16).padEnd(16)} ${show(values)}`;
    const r = three(exact), t = three(right), lines = [place(x * texel_px, y * texel_px, scene, texel_px), line('exact', r)];
    if (state.split > 0 && state.left > 0 && state.left !== state.image) lines.push(line(scene.images[state.left], three(left)));
    lines.push(line(scene.images[state.image], t), line('difference', t.map((v, c) => v - r[c])));
    if (flip) lines.push(line('FLIP', [one(flip)]));
    if (angle) lines.push(one(angle) < 0 ? 'exit angle       no exit on both sides' : `${line('exit angle', [one(angle)])}°`);
    byId('v-pixel').textContent = lines.join('\n');
  }

  // How many pixels have which luminance, in stops: the image filled, the exact one as a line.
  function histogram() {
    const box = byId('v-histogram'), bins = 80, low = -12, high = 8;
    const count = ({ bits }) => {
      const counts = new Float64Array(bins);
      for (let i = 0; i < bits.length; i += 3) {
        const [r, g, b] = [0, 1, 2].map((c) => picture.half(bits[i + c]));
        const stops = Math.log2(Math.max(0.2126 * r + 0.7152 * g + 0.0722 * b, 1e-9)) + state.ev;
        counts[Math.min(bins - 1, Math.max(0, Math.floor((stops - low) / (high - low) * bins)))]++;
      }
      return counts;
    };
    const [image, exact] = [ready.right, ready.exact].map((it) => {
      it.counts = it.counts && it.counts.ev === state.ev ? it.counts : Object.assign(count(it), { ev: state.ev });
      return it.counts;
    });
    const most = Math.max(...image, ...exact), path = (counts) =>
      Array.from(counts, (n, i) => `${i},${40 - 38 * n / most} ${i + 1},${40 - 38 * n / most}`).join(' ');
    box.querySelector('polygon').setAttribute('points', `0,40 ${path(image)} ${bins},40`);
    box.querySelector('polyline').setAttribute('points', path(exact));
  }

  // One pointer drags the split or the image; two pinch.
  const held = new Map();
  let grip = null;
  function zoomAt(at, zoom) {
    const before = pixelAt(at);
    state.zoom = Math.min(64, Math.max(1, zoom));
    const after = pixelAt(at);
    update({ x: state.x + before[0] - after[0], y: state.y + before[1] - after[1] });
  }
  const spread = () => { const [a, b] = [...held.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    const at = point(event);
    held.set(event.pointerId, at);
    const onSplit = state.split > 0 && Math.abs(at[0] - state.split * canvas.width) < 14 * (window.devicePixelRatio || 1);
    grip = held.size === 2 ? { spread: spread(), zoom: state.zoom } : { at, onSplit, x: state.x, y: state.y };
  });
  canvas.addEventListener('pointermove', (event) => {
    const at = pointed = point(event);
    inspect();
    if (!held.has(event.pointerId) || !grip) return;
    held.set(event.pointerId, at);
    if (held.size === 2) {
      const [a, b] = [...held.values()];
      zoomAt([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], grip.zoom * spread() / grip.spread);
    } else if (grip.onSplit) update({ split: Math.min(1, Math.max(0.001, at[0] / canvas.width)) });
    else if (grip.at) update({ x: grip.x - (at[0] - grip.at[0]) / scaleNow(), y: grip.y - (at[1] - grip.at[1]) / scaleNow() });
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => { held.delete(event.pointerId); grip = null; });
  // The wheel zooms; where nothing is left to zoom out of, it scrolls the page again.
  canvas.addEventListener('wheel', (event) => {
    if (event.deltaY > 0 && state.zoom <= 1) return;
    event.preventDefault();
    zoomAt(point(event), state.zoom * 2 ** (-event.deltaY / 200));
  }, { passive: false });

  const whole = () => { const s = sceneNow(); update({ x: s.width / 2, y: s.height / 2, zoom: 1 }); };
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(SELECT|INPUT|TEXTAREA)$/.test(event.target.tagName)) return;
    const count = sceneNow().images.length, scenes = contents.scenes.length;
    if (/^[1-9]$/.test(event.key) && Number(event.key) <= count) update({ image: Number(event.key) - 1 });
    else if (event.key === 'ArrowRight') update({ image: (state.image + 1) % count });
    else if (event.key === 'ArrowLeft') update({ image: (state.image + count - 1) % count });
    else if (event.key === 'n') choose((state.scene + 1) % scenes, {});
    else if (event.key === 'N') choose((state.scene + scenes - 1) % scenes, {});
    else if (event.key === '0') whole();
    else if (event.key === '+' || event.key === '=') zoomAt([canvas.width / 2, canvas.height / 2], state.zoom * 2);
    else if (event.key === '-') zoomAt([canvas.width / 2, canvas.height / 2], state.zoom / 2);
    else if (event.key === 's') update({ split: state.split > 0 ? 0 : 0.5 });
    else if (event.key === 'e') update({ ev: Math.min(10, state.ev + 0.25) });
    else if (event.key === 'E') update({ ev: Math.max(-10, state.ev - 0.25) });
    else if (event.key === 'm') update({ mode: (state.mode + 1) % MODES.length });
    else return;
    event.preventDefault?.();
  });
  byId('v-scene').replaceChildren(...contents.scenes.map((scene, i) => new Option(scene.name, i)));
  byId('v-scene').addEventListener('change', (event) => choose(Number(event.target.value), {}));
  byId('v-left').addEventListener('change', (event) => update({ left: Number(event.target.value), split: state.split || 0.5 }));
  byId('v-mode').addEventListener('change', (event) => update({ mode: Number(event.target.value) }));
  byId('v-ev').addEventListener('input', (event) => update({ ev: Number(event.target.value) }));
  byId('v-reset').addEventListener('click', whole);
  window.addEventListener('hashchange', restore);
  window.addEventListener('resize', () => draw());
  if (!restore()) choose(0);
})();
