'use strict';
// Half-float HDR images on a canvas: decoding, textures, the shader that shows them.
// `snellPicture(canvas, ramps)` is null where the browser cannot do it.
function snellPicture(canvas, ramp_bytes) {
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl || typeof DecompressionStream === 'undefined') return null;

  const VERTEX = `#version 300 es
    void main() {
      vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
      gl_Position = vec4(p, 0.0, 1.0);
    }`;
  const FRAGMENT = `#version 300 es
    precision highp float;
    uniform sampler2D right_image, left_image, exact_image, right_map, left_map, ramp;
    uniform vec2 canvas_px, centre_px, size_px;
    uniform float zoom_px, texel_px, split_px, ev, has_left_map, has_right_map;
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
      vec2 pixel = (at - 0.5 * canvas_px) / zoom_px + centre_px;
      if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, size_px))) {
        colour = vec4(vec3(0.12), 1.0);
        return;
      }
      if (split_px > 0.0 && abs(at.x - split_px) < 1.0) { colour = vec4(1.0); return; }
      bool is_left = at.x < split_px;
      ivec2 i = ivec2(pixel / texel_px);
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
  const colours = Uint8Array.from(atob(ramp_bytes), (c) => c.charCodeAt(0));
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 2, 0, gl.RGB, gl.UNSIGNED_BYTE, colours);

  const half = (bits) => {
    const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  };

  // Undoes the coding: zlib, low bytes then high bytes, differences along rows, planes.
  async function decode(text, width, height, channels) {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
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
    return { bits, texture: texture(bits, width, height, channels) };
  }

  // images: right, left, exact, rightMap, leftMap (the maps may be null); view: centre and
  // size in pixels of the file, zoom_px in canvas pixels per pixel, texel_px in pixels.
  function draw(images, view) {
    gl.viewport(0, 0, canvas.width, canvas.height);
    const bind = (unit, name, it) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, it);
      gl.uniform1i(uniform(name), unit);
    };
    bind(0, 'right_image', images.right.texture);
    bind(1, 'left_image', images.left.texture);
    bind(2, 'exact_image', images.exact.texture);
    bind(3, 'right_map', images.rightMap ? images.rightMap.texture : nothing);
    bind(4, 'left_map', images.leftMap ? images.leftMap.texture : nothing);
    bind(5, 'ramp', ramps);
    gl.uniform1f(uniform('has_right_map'), images.rightMap ? 1 : 0);
    gl.uniform1f(uniform('has_left_map'), images.leftMap ? 1 : 0);
    gl.uniform2f(uniform('canvas_px'), canvas.width, canvas.height);
    gl.uniform2f(uniform('centre_px'), ...view.centre_px);
    gl.uniform2f(uniform('size_px'), ...view.size_px);
    for (const name of ['zoom_px', 'texel_px', 'split_px', 'ev']) gl.uniform1f(uniform(name), view[name]);
    gl.uniform1i(uniform('mode'), view.mode);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
  return { decode, draw, half };
}
