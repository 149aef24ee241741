'use strict';
// Shows half-float HDR images on one canvas: flips, splits, exposure, error
// modes, zoom, values under the pointer. State lives in the address (#v=...).
(() => {
  const contents = JSON.parse(document.getElementById('viewer-data').textContent);
  const byId = (id) => document.getElementById(id);
  const canvas = byId('v-canvas');
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl || typeof DecompressionStream === 'undefined') return;
  byId('viewer').hidden = false;

  const MODES = ['radiance', 'difference', 'relative', 'flip', 'angle'];
  // scene: place in contents; image, left: 0 is the exact one; split: 0..1, where
  // images left of it come from `left`; x, y: centre in pixels; zoom: 1 = whole.
  const state = { scene: 0, image: 1, left: 0, split: 0.5, mode: 0, ev: 0, x: 0, y: 0, zoom: 1 };

  const VERTEX = `#version 300 es
    void main() {
      vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
      gl_Position = vec4(p, 0.0, 1.0);
    }`;
  const FRAGMENT = `#version 300 es
    precision highp float;
    uniform sampler2D right_image, left_image, exact_image, right_map, left_map, ramp;
    uniform vec2 canvas_px, centre_px, size_px;
    uniform float pixels_per_texel, split_px, ev, has_left_map, has_right_map;
    uniform int mode;
    out vec4 colour;
    vec3 encode(vec3 c) {
      return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
    }
    vec3 film(vec3 c) {
      vec3 x = max(0.6 * c * exp2(ev), 0.0);
      return encode(clamp((2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14), 0.0, 1.0));
    }
    vec3 scale(float share, int row) {
      return texelFetch(ramp, ivec2(int(clamp(share, 0.0, 1.0) * 255.0 + 0.5), row), 0).rgb;
    }
    void main() {
      vec2 at = vec2(gl_FragCoord.x, canvas_px.y - gl_FragCoord.y);
      vec2 texel = (at - 0.5 * canvas_px) / pixels_per_texel + centre_px;
      if (any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, size_px))) {
        colour = vec4(vec3(0.12), 1.0);
        return;
      }
      if (split_px > 0.0 && abs(at.x - split_px) < 1.0) { colour = vec4(1.0); return; }
      bool is_left = at.x < split_px;
      ivec2 i = ivec2(texel);
      vec3 t = is_left ? texelFetch(left_image, i, 0).rgb : texelFetch(right_image, i, 0).rgb;
      vec3 r = texelFetch(exact_image, i, 0).rgb;
      float m = is_left ? texelFetch(left_map, i, 0).r : texelFetch(right_map, i, 0).r;
      bool has = (is_left ? has_left_map : has_right_map) > 0.5;
      vec3 c;
      if (mode == 0) c = film(t);
      else if (mode == 1) c = film(abs(t - r));
      else if (mode == 2) {
        vec3 e = (t - r) * (t - r) / (r * r + 0.01);
        c = scale(sqrt((e.r + e.g + e.b) / 3.0), 0);
      }
      else if (!has) c = film(t);
      else if (mode == 3) c = scale(m, 1);
      else c = m < 0.0 ? vec3(0.5) : scale(log(max(m, 1e-6) / 0.1) / log(900.0), 0);
      colour = vec4(c, 1.0);
    }`;

  function compile(kind, source) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    return shader;
  }
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl.VERTEX_SHADER, VERTEX));
  gl.attachShader(program, compile(gl.FRAGMENT_SHADER, FRAGMENT));
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);

  // A texture of one or three channels of half floats (given as their bits).
  function texture(bits, width, height, channels) {
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const [internal, format] = channels === 3 ? [gl.RGB16F, gl.RGB] : [gl.R16F, gl.RED];
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, gl.HALF_FLOAT, bits);
    return made;
  }
  const nothing = texture(new Uint16Array(1), 1, 1, 1);
  // Two rows of colours: angles and differences, FLIP.
  const ramps = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, ramps);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  const colours = Uint8Array.from(atob(contents.ramps), (c) => c.charCodeAt(0));
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 2, 0, gl.RGB, gl.UNSIGNED_BYTE, colours);

  const half = (bits) => {
    const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  };

  // Undoes the coding: zlib, low bytes then high bytes, differences along rows, planes.
  async function decode(id, width, height, channels) {
    const element = byId(id);
    if (!element) return null;
    const packed = Uint8Array.from(atob(element.textContent), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const pixels = width * height, count = pixels * channels, bits = new Uint16Array(count);
    for (let plane = 0, from = 0; plane < channels; plane++) {
      for (let y = 0; y < height; y++) {
        let value = 0;
        for (let x = 0; x < width; x++, from++) {
          value = value + bytes[from] + (bytes[from + count] << 8) & 0xffff;
          bits[(y * width + x) * channels + plane] = value;
        }
      }
    }
    return bits;
  }

  const decoded = new Map();
  function get(scene, image, kind) {
    const key = `data-${scene.index}-${image}-${kind}`;
    if (!decoded.has(key)) {
      const channels = kind === 'radiance' ? 3 : 1;
      decoded.set(key, decode(key, scene.width, scene.height, channels).then((bits) =>
        bits && { bits, texture: texture(bits, scene.width, scene.height, channels) }));
    }
    return decoded.get(key);
  }

  let ready = null;
  let drawing = 0;
  async function draw() {
    const turn = ++drawing;
    const scene = contents.scenes[state.scene];
    const kind = MODES[state.mode];
    const map = kind === 'flip' || kind === 'angle' ? kind : null;
    const [exact, right, left, rightMap, leftMap] = await Promise.all([
      get(scene, 0, 'radiance'), get(scene, state.image, 'radiance'), get(scene, state.left, 'radiance'),
      map && get(scene, state.image, map), map && get(scene, state.left, map)]);
    if (turn !== drawing) return;
    const flip = await get(scene, state.image, 'flip');
    const angle = await get(scene, state.image, 'angle');
    if (turn !== drawing) return;
    ready = { scene, exact, right, flip, angle };
    const width = canvas.clientWidth;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(width * ratio * Math.min(1, scene.height / scene.width));
    canvas.style.aspectRatio = `${canvas.width} / ${canvas.height}`;
    gl.viewport(0, 0, canvas.width, canvas.height);
    const bind = (unit, name, it) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, it);
      gl.uniform1i(uniform(name), unit);
    };
    bind(0, 'right_image', right.texture);
    bind(1, 'left_image', left.texture);
    bind(2, 'exact_image', exact.texture);
    bind(3, 'right_map', rightMap ? rightMap.texture : nothing);
    bind(4, 'left_map', leftMap ? leftMap.texture : nothing);
    bind(5, 'ramp', ramps);
    gl.uniform1f(uniform('has_right_map'), rightMap ? 1 : 0);
    gl.uniform1f(uniform('has_left_map'), leftMap ? 1 : 0);
    gl.uniform2f(uniform('canvas_px'), canvas.width, canvas.height);
    gl.uniform2f(uniform('centre_px'), state.x, state.y);
    gl.uniform2f(uniform('size_px'), scene.width, scene.height);
    gl.uniform1f(uniform('pixels_per_texel'), scaleNow());
    gl.uniform1f(uniform('split_px'), state.split * canvas.width);
    gl.uniform1f(uniform('ev'), state.ev);
    gl.uniform1i(uniform('mode'), state.mode);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    canvas.dataset.drawn = turn;
  }
  const scaleNow = () => state.zoom * canvas.width / contents.scenes[state.scene].width;

  function controls() {
    const scene = contents.scenes[state.scene];
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
    byId('v-left-name').textContent = state.split > 0 ? scene.images[state.left] : '';
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
    return `#v=${contents.scenes[s.scene].index}.${s.image}.${MODES[s.mode]}&left=${s.left}&split=${short(s.split)}` +
      `&ev=${short(s.ev)}&x=${short(s.x)}&y=${short(s.y)}&zoom=${short(s.zoom)}`;
  };
  let quiet = false;
  function update(change, keepAddress) {
    Object.assign(state, change);
    const scene = contents.scenes[state.scene];
    state.image = Math.min(state.image, scene.images.length - 1);
    state.left = Math.min(state.left, scene.images.length - 1);
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

  const point = (event) => {
    const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width;
    return [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio];
  };
  const texelAt = ([x, y]) => [(x - canvas.width / 2) / scaleNow() + state.x, (y - canvas.height / 2) / scaleNow() + state.y];
  function inspect(event) {
    if (!ready) return;
    const [x, y] = texelAt(point(event)).map(Math.floor), { scene, exact, right, flip, angle } = ready;
    if (x < 0 || y < 0 || x >= scene.width || y >= scene.height) return;
    const at = y * scene.width + x, three = (it) => [0, 1, 2].map((c) => half(it.bits[3 * at + c]));
    const show = (values) => values.map((v) => v.toPrecision(4).padStart(11)).join(' ');
    const r = three(exact), t = three(right), lines = [`pixel ${x}, ${y}`, `exact       ${show(r)}`];
    lines.push(`${scene.images[state.image].slice(0, 11).padEnd(11)} ${show(t)}`, `difference  ${show(t.map((v, c) => v - r[c]))}`);
    if (flip) lines.push(`FLIP        ${show([half(flip.bits[at])])}`);
    if (angle) lines.push(`exit angle  ${half(angle.bits[at]) < 0 ? '         no exit on both sides' : show([half(angle.bits[at])]) + '°'}`);
    byId('v-pixel').textContent = lines.join('\n');
  }

  let held = null;
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    const at = point(event);
    const onSplit = state.split > 0 && Math.abs(at[0] - state.split * canvas.width) < 14 * (window.devicePixelRatio || 1);
    held = { at, onSplit, x: state.x, y: state.y };
  });
  canvas.addEventListener('pointermove', (event) => {
    inspect(event);
    if (!held) return;
    const at = point(event);
    if (held.onSplit) update({ split: Math.min(1, Math.max(0.001, at[0] / canvas.width)) });
    else update({ x: held.x - (at[0] - held.at[0]) / scaleNow(), y: held.y - (at[1] - held.at[1]) / scaleNow() });
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { held = null; });
  canvas.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    event.preventDefault();
    const before = texelAt(point(event));
    const zoom = Math.min(64, Math.max(1, state.zoom * 2 ** (-event.deltaY / 200)));
    state.zoom = zoom;
    const after = texelAt(point(event));
    update({ x: state.x + before[0] - after[0], y: state.y + before[1] - after[1] });
  }, { passive: false });
  const whole = () => { const s = contents.scenes[state.scene]; update({ x: s.width / 2, y: s.height / 2, zoom: 1 }); };
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(SELECT|INPUT|TEXTAREA)$/.test(event.target.tagName)) return;
    const count = contents.scenes[state.scene].images.length;
    if (/^[1-9]$/.test(event.key) && Number(event.key) <= count) update({ image: Number(event.key) - 1 });
    else if (event.key === '0') whole();
    else if (event.key === 's') update({ split: state.split > 0 ? 0 : 0.5 });
    else if (event.key === 'e') update({ ev: Math.min(10, state.ev + 0.25) });
    else if (event.key === 'E') update({ ev: Math.max(-10, state.ev - 0.25) });
    else if (event.key === 'm') update({ mode: (state.mode + 1) % MODES.length });
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
