// Live pages hold the program and the viewer gzipped, as texts of seven bits a character (src/view/encode.rs).
'use strict';

/** The bytes of such a text. */
globalThis.unpacked = (text) => {
  const bytes = new Uint8Array(Math.floor((text.length * 7) / 8));
  let [at, bits, count] = [0, 0, 0];
  for (let k = 0; k < text.length; k += 1) {
    bits = ((bits << 7) | (text.charCodeAt(k) & 127)) & 0xffff;
    count += 7;
    if (count >= 8) {
      count -= 8;
      bytes[at] = bits >> count;
      at += 1;
    }
  }
  return bytes;
};

/** Runs the viewer, which stands in the page. */
(async () => {
  const packed = new Blob([globalThis.unpacked(document.getElementById('viewer').textContent)]);
  const script = document.createElement('script');
  script.textContent = await new Response(packed.stream().pipeThrough(new DecompressionStream('gzip'))).text();
  document.body.append(script);
})();
