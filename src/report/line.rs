//! JSON as text, in few steps: an answer has some two hundred keys and numbers, and writing them one by one takes as long as finding it.

use serde::ser::{
    Error, Impossible, Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeTuple, Serializer,
};
use serde_json::Result;

/// Appends a value to a text as `serde_json` would write it. Keys are strings.
///
/// # Errors
/// For values that JSON does not have.
pub fn append(value: &impl Serialize, text: &mut Vec<u8>) -> Result<()> {
    value.serialize(Writer(text))
}

/// The text so far.
struct Writer<'a>(&'a mut Vec<u8>);

/// A list or an object that is begun.
struct Begun<'a> {
    text: &'a mut Vec<u8>,
    /// Whether nothing stands in it yet.
    is_empty: bool,
    /// The bracket that ends it.
    end: u8,
}

/// What no value of a report is.
fn unused<T>() -> Result<T> {
    Err(Error::custom("a value that reports do not have"))
}

impl<'a> Writer<'a> {
    fn begin(self, brackets: [u8; 2]) -> Begun<'a> {
        self.0.push(brackets[0]);
        Begun { text: self.0, is_empty: true, end: brackets[1] }
    }

    fn plain(self, text: &str) {
        self.0.extend_from_slice(text.as_bytes());
    }
}

impl Begun<'_> {
    /// Returns what writes the next element.
    fn next(&mut self) -> Writer<'_> {
        if !self.is_empty {
            self.text.push(b',');
        }
        self.is_empty = false;
        Writer(self.text)
    }

    fn finish(self) {
        self.text.push(self.end);
    }
}

/// Returns whether JSON writes these characters as they are.
fn is_plain(text: &str) -> bool {
    // All bytes are looked at, so that many are at a time.
    let special = |byte: u8| u8::from(byte < b' ') | u8::from(byte == b'"') | u8::from(byte == b'\\');
    text.bytes().fold(0, |found, byte| found | special(byte)) == 0
}

impl<'a> Serializer for Writer<'a> {
    type Ok = ();
    type Error = serde_json::Error;
    type SerializeSeq = Begun<'a>;
    type SerializeTuple = Begun<'a>;
    type SerializeTupleStruct = Impossible<(), Self::Error>;
    type SerializeTupleVariant = Impossible<(), Self::Error>;
    type SerializeMap = Begun<'a>;
    type SerializeStruct = Begun<'a>;
    type SerializeStructVariant = Impossible<(), Self::Error>;

    fn serialize_bool(self, own: bool) -> Result<()> {
        self.plain(if own { "true" } else { "false" });
        Ok(())
    }
    fn serialize_i8(self, own: i8) -> Result<()> {
        self.serialize_i64(own.into())
    }
    fn serialize_i16(self, own: i16) -> Result<()> {
        self.serialize_i64(own.into())
    }
    fn serialize_i32(self, own: i32) -> Result<()> {
        self.serialize_i64(own.into())
    }
    fn serialize_i64(self, own: i64) -> Result<()> {
        self.plain(itoa::Buffer::new().format(own));
        Ok(())
    }
    fn serialize_u8(self, own: u8) -> Result<()> {
        self.serialize_u64(own.into())
    }
    fn serialize_u16(self, own: u16) -> Result<()> {
        self.serialize_u64(own.into())
    }
    fn serialize_u32(self, own: u32) -> Result<()> {
        self.serialize_u64(own.into())
    }
    fn serialize_u64(self, own: u64) -> Result<()> {
        self.plain(itoa::Buffer::new().format(own));
        Ok(())
    }
    fn serialize_f32(self, own: f32) -> Result<()> {
        serde_json::to_writer(self.0, &own)
    }
    fn serialize_f64(self, own: f64) -> Result<()> {
        if own.is_finite() {
            self.plain(zmij::Buffer::new().format_finite(own));
            return Ok(());
        }
        self.serialize_unit()
    }
    fn serialize_char(self, own: char) -> Result<()> {
        self.serialize_str(own.encode_utf8(&mut [0; 4]))
    }
    fn serialize_str(self, own: &str) -> Result<()> {
        if !is_plain(own) {
            return serde_json::to_writer(self.0, own);
        }
        self.0.reserve(own.len() + 2);
        self.0.push(b'"');
        self.0.extend_from_slice(own.as_bytes());
        self.0.push(b'"');
        Ok(())
    }
    fn serialize_bytes(self, _: &[u8]) -> Result<()> {
        unused()
    }
    fn serialize_none(self) -> Result<()> {
        self.serialize_unit()
    }
    fn serialize_some<T: Serialize + ?Sized>(self, own: &T) -> Result<()> {
        own.serialize(self)
    }
    fn serialize_unit(self) -> Result<()> {
        self.plain("null");
        Ok(())
    }
    fn serialize_unit_struct(self, _: &'static str) -> Result<()> {
        self.serialize_unit()
    }
    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Result<()> {
        self.serialize_str(variant)
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, own: &T) -> Result<()> {
        own.serialize(self)
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Result<()> {
        unused()
    }
    fn serialize_seq(self, _: Option<usize>) -> Result<Begun<'a>> {
        Ok(self.begin(*b"[]"))
    }
    fn serialize_tuple(self, _: usize) -> Result<Begun<'a>> {
        Ok(self.begin(*b"[]"))
    }
    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Self::SerializeTupleStruct> {
        unused()
    }
    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant> {
        unused()
    }
    fn serialize_map(self, _: Option<usize>) -> Result<Begun<'a>> {
        Ok(self.begin(*b"{}"))
    }
    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Begun<'a>> {
        Ok(self.begin(*b"{}"))
    }
    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStructVariant> {
        unused()
    }
}

impl SerializeSeq for Begun<'_> {
    type Ok = ();
    type Error = serde_json::Error;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, own: &T) -> Result<()> {
        own.serialize(self.next())
    }
    fn end(self) -> Result<()> {
        self.finish();
        Ok(())
    }
}

impl SerializeTuple for Begun<'_> {
    type Ok = ();
    type Error = serde_json::Error;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, own: &T) -> Result<()> {
        own.serialize(self.next())
    }
    fn end(self) -> Result<()> {
        self.finish();
        Ok(())
    }
}

impl SerializeMap for Begun<'_> {
    type Ok = ();
    type Error = serde_json::Error;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<()> {
        key.serialize(self.next())
    }
    fn serialize_value<T: Serialize + ?Sized>(&mut self, own: &T) -> Result<()> {
        self.text.push(b':');
        own.serialize(Writer(self.text))
    }
    fn end(self) -> Result<()> {
        self.finish();
        Ok(())
    }
}

impl SerializeStruct for Begun<'_> {
    type Ok = ();
    type Error = serde_json::Error;

    fn serialize_field<T: Serialize + ?Sized>(&mut self, key: &'static str, own: &T) -> Result<()> {
        self.serialize_entry(key, own)
    }
    fn end(self) -> Result<()> {
        self.finish();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn of(value: &Value) -> String {
        let mut text = Vec::new();
        append(value, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn values_are_written_as_by_serde_json() {
        let numbers = [0.0, -0.0, 1.0, -1.5, 0.1, 1e21, 1e-7, 1.224_646_799_147_353_2e-16, f64::MAX, f64::MIN_POSITIVE];
        let text = "plain, \"quoted\", \\ and \u{1}\u{7f}\n, \u{e4}\u{1f600}";
        let values = [
            json!(null),
            json!([]),
            json!({}),
            json!([[], {}, [true, false, null]]),
            json!(numbers),
            json!({ "list": numbers, text: text, "nested": { "k": [1, -2, u64::MAX, i64::MIN], "x": {} }, "": "" }),
        ];
        for value in values {
            assert_eq!(of(&value), value.to_string());
        }
        assert_eq!(of(&json!(f64::NAN)), "null");
        // Tuples, options and characters are no values yet when they are written.
        let mixed = (Some('"'), None::<u8>, (1_i8, 0.5_f32), "x", [1_u16; 3]);
        let mut text = Vec::new();
        append(&mixed, &mut text).unwrap();
        assert_eq!(String::from_utf8(text).unwrap(), serde_json::to_string(&mixed).unwrap());
    }
}
