// Live pages hold the program and the viewer gzipped, as texts of seven bits a byte (src/view/encode.rs).
'use strict';

/** The bytes of such a text: a character of one byte is seven bits, one of two bytes an unsafe group and the next, or the last. */
globalThis.unpacked = (text) => {
  const unsafe = [0, 10, 13, 60];
  const bytes = new Uint8Array(Math.ceil((text.length * 14) / 8));
  let [at, bits, count] = [0, 0, 0];
  const put = (group) => {
    bits = ((bits << 7) | group) & 0xffff;
    count += 7;
    if (count >= 8) {
      count -= 8;
      bytes[at] = bits >> count;
      at += 1;
    }
  };
  for (let k = 0; k < text.length; k += 1) {
    const code = text.charCodeAt(k);
    const place = code >> 7;
    if (place > 0 && place <= unsafe.length) put(unsafe[place - 1]);
    put(code & 127);
  }
  return bytes.slice(0, at);
};

/** Runs the viewer, which stands in the page. */
(async () => {
  const packed = new Blob([globalThis.unpacked(document.getElementById('viewer').textContent)]);
  const script = document.createElement('script');
  script.textContent = await new Response(packed.stream().pipeThrough(new DecompressionStream('gzip'))).text();
  document.body.append(script);
})();
