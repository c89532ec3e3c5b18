//! Encodings inside a page: numbers as base64, files as seven bits a character, JSON inside a script.

use serde_json::Value;

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The largest 16-bit integer.
const FULL: f64 = 32767.0;

/// Poses of seven numbers each as base64 of little-endian 16-bit integers: quaternions in units of 1/32767, positions in
/// units of `reach`/32767. That is a quarter of a pixel on a large screen, and a quarter of the length of decimal text.
pub(super) fn poses(numbers: impl Iterator<Item = f64>, reach: f64) -> String {
    #[allow(clippy::cast_possible_truncation)]
    let short = |(place, x): (usize, f64)| {
        let unit = if place % 7 < 4 { 1.0 } else { reach };
        (FULL * (x / unit).clamp(-1.0, 1.0)).round() as i16
    };
    let bytes: Vec<u8> = numbers.enumerate().flat_map(|number| short(number).to_le_bytes()).collect();
    base64(&bytes)
}

/// Bytes as base64.
pub(super) fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |k: usize| usize::from(chunk.get(k).copied().unwrap_or(0));
        let digits = [byte(0) >> 2, byte(0) << 4 | byte(1) >> 4, byte(1) << 2 | byte(2) >> 6, byte(2)];
        for (place, digit) in digits.into_iter().enumerate() {
            text.push(if place > chunk.len() { '=' } else { char::from(DIGITS[digit & 63]) });
        }
    }
    text
}

/// Packs bytes into a text of seven bits a character, for a script element: base64 takes a seventh more. The characters that HTML or an
/// editor may change stand 128 places further on, where their last seven bits are the same.
pub(super) fn packed(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() * 6 / 5 + 2);
    let mut put = |bits: u32| {
        let code = (bits & 0x7f) as u8;
        text.push(char::from(if matches!(code, 0 | b'\n' | b'\r' | b'<') { code | 0x80 } else { code }));
    };
    let (mut bits, mut count) = (0_u32, 0);
    for byte in bytes {
        bits = bits << 8 | u32::from(*byte);
        count += 8;
        while count >= 7 {
            count -= 7;
            put(bits >> count);
        }
        bits &= (1 << count) - 1;
    }
    if count > 0 {
        put(bits << (7 - count));
    }
    text
}

/// JSON that a script element can hold: nothing in it ends the element or begins a comment.
pub(super) fn script(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn poses_are_base64_of_their_bytes() {
        // 1.0 is ff 7f, 0.0 is 00 00, 2.0 of 4.0 is 00 40, -4.0 of 4.0 is 01 80.
        let pose = [1.0, 0.0, 0.0, 0.0, 2.0, 0.0, -4.0];
        assert_eq!(poses(pose.into_iter(), 4.0), "/38AAAAAAAAAQAAAAYA=");
        assert_eq!(poses([1.0].into_iter(), 4.0), "/38=");
    }

    #[test]
    fn files_are_texts_of_seven_bits_a_character() {
        let bytes: Vec<u8> = (0..=255).chain([0, 0, 10, 13, 60, 255, 7]).collect();
        let text = packed(&bytes);
        assert!(!text.contains(['\0', '\n', '\r', '<']));
        // As the script reads them: the last seven bits of every character.
        let bits: Vec<bool> = text.chars().flat_map(|c| (0..7).rev().map(move |k| u32::from(c) >> k & 1 == 1)).collect();
        let read = bits.chunks_exact(8).map(|own| own.iter().fold(0, |byte, bit| byte << 1 | u8::from(*bit)));
        assert_eq!(read.collect::<Vec<u8>>(), bytes);
        assert_eq!(text.chars().count(), (8 * bytes.len()).div_ceil(7));
    }

    #[test]
    fn no_text_ends_a_script() {
        let text = script(&json!({ "title": "</script><!--" }));
        assert!(!text.contains('<'), "{text}");
        assert_eq!(serde_json::from_str::<Value>(&text).ok(), Some(json!({ "title": "</script><!--" })));
    }
}
