//! Encodings inside a page: numbers as base64, files as seven bits a byte, JSON inside a script.

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

/// The groups of seven bits that are no character of a text: HTML or an editor may change them.
const UNSAFE: [u8; 4] = [0, b'\n', b'\r', b'<'];

/// Packs bytes into a text of seven bits a byte, for a script element: base64 takes a seventh more. A group of seven bits is the ASCII
/// character with that code. The k-th one that is unsafe and the group after it are the one character with the code 128 (k + 1) plus
/// the second group, which has two bytes in UTF-8: nothing is lost. An unsafe group at the end is that of 128 * 5.
pub(super) fn packed(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() * 8 / 7 + 2);
    let mut held = None;
    let mut put = |group: u32| {
        let safe = u8::try_from(group).ok().and_then(|code| UNSAFE.iter().position(|own| *own == code));
        let code = match (held.take(), safe) {
            (Some(place), _) => 128 * (place + 1) + group,
            (None, Some(place)) => {
                held = u32::try_from(place).ok();
                return;
            }
            (None, None) => group,
        };
        text.extend(char::from_u32(code));
    };
    let (mut bits, mut count) = (0_u32, 0);
    for byte in bytes {
        bits = bits << 8 | u32::from(*byte);
        count += 8;
        while count >= 7 {
            count -= 7;
            put(bits >> count & 0x7f);
        }
        bits &= (1 << count) - 1;
    }
    if count > 0 {
        put(bits << (7 - count) & 0x7f);
    }
    if let Some(place) = held {
        text.extend(char::from_u32(128 * 5 + u32::from(UNSAFE[place as usize])));
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
    fn files_are_texts_of_seven_bits_a_byte() {
        let all: Vec<u8> = (0..=255).chain([0, 0, 10, 13, 60, 255, 7]).collect();
        // All lengths, so that every group is once the last one; zeros alone, of which every group is unsafe.
        for bytes in (0..all.len()).map(|length| &all[..length]).chain([&all[..], &[0; 7], &[0; 8], &[0; 14], &[0; 15]])
        {
            let text = packed(bytes);
            assert!(!text.contains(['\0', '\n', '\r', '<']));
            assert!(text.len() <= (8 * bytes.len()).div_ceil(7) + 1, "{} bytes of {}", text.len(), bytes.len());
            assert_eq!(unpacked(&text), bytes);
        }
    }

    /// Returns the bytes of a text, as the script of a live page reads them.
    fn unpacked(text: &str) -> Vec<u8> {
        let mut bits: Vec<bool> = Vec::new();
        let mut put = |group: u32| bits.extend((0..7).rev().map(|k| group >> k & 1 == 1));
        for code in text.chars().map(u32::from) {
            if let 1..=4 = code >> 7 {
                put(u32::from(UNSAFE[(code >> 7) as usize - 1]));
            }
            put(code & 127);
        }
        bits.chunks_exact(8).map(|own| own.iter().fold(0, |byte, bit| byte << 1 | u8::from(*bit))).collect()
    }

    #[test]
    fn no_text_ends_a_script() {
        let text = script(&json!({ "title": "</script><!--" }));
        assert!(!text.contains('<'), "{text}");
        assert_eq!(serde_json::from_str::<Value>(&text).ok(), Some(json!({ "title": "</script><!--" })));
    }
}
