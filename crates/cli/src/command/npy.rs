//! Arrays of numpy: the head of a file, and the numbers of its rows, read one row at a time.

use looproot::internal::error::Error;
use std::io::{ErrorKind, Read};

/// What every file of numpy begins with.
pub const MAGIC: &[u8; 6] = b"\x93NUMPY";
/// Longest head, bytes: that of an array of numbers has less than two hundred.
const LONGEST: u32 = 1 << 16;
const EXPECTED: &str = "expected the shape (n, 4, 4) or (n, 7), x, y, z, qw, qx, qy, qz, of float64 or float32";

/// The numbers of a row, and how many there are.
pub type Numbers = ([f64; 12], usize);

/// The rows of an array of poses that are left to be read.
pub struct Array {
    /// How many rows the file says that it has.
    pub count: usize,
    /// How many numbers a row has.
    width: usize,
    is_double: bool,
    is_big_endian: bool,
}

impl Array {
    /// Reads the head of a file.
    ///
    /// # Errors
    /// For an array of another shape or type than one of poses.
    pub fn open(input: &mut dyn Read) -> Result<Self, Error> {
        let mut lead = [0; 8];
        read(input, &mut lead)?;
        let length = if lead[6] == 1 {
            let mut length = [0; 2];
            read(input, &mut length)?;
            u32::from(u16::from_le_bytes(length))
        } else {
            let mut length = [0; 4];
            read(input, &mut length)?;
            u32::from_le_bytes(length)
        };
        if length > LONGEST {
            return Err(Error::Invalid(format!("found a head of {length} bytes, expected less than {LONGEST}")));
        }
        let mut head = vec![0; length as usize];
        read(input, &mut head)?;
        Self::of(&String::from_utf8_lossy(&head))
    }

    /// Reads the head of an array, a dictionary of Python.
    fn of(head: &str) -> Result<Self, Error> {
        let fault = |found: &str| Error::Invalid(format!("found {found}, {EXPECTED}"));
        let value = |key: &str| {
            let behind = &head[head.find(&format!("'{key}'"))? + key.len() + 2..];
            Some(behind.trim_start().strip_prefix(':')?.trim_start())
        };
        let quoted = |text: &str| Some(text.strip_prefix('\'')?.split('\'').next()?.to_owned());
        let Some(kind) = value("descr").and_then(quoted) else {
            return Err(fault("no single type in the head of the array"));
        };
        let is_big_endian = kind.starts_with('>');
        let is_double = match kind.trim_start_matches(['<', '>', '=']) {
            "f8" => true,
            "f4" => false,
            _ => return Err(fault(&format!("an array of the type `{kind}`"))),
        };
        let list = value("shape").and_then(|text| text.strip_prefix('(')?.split(')').next());
        let sizes = |list: &str| -> Option<Vec<usize>> {
            list.split(',').map(str::trim).filter(|size| !size.is_empty()).map(|size| size.parse().ok()).collect()
        };
        let Some(shape) = list.and_then(sizes) else { return Err(fault("no shape in the head of the array")) };
        let (count, width) = match shape[..] {
            [count, 4, 4] => (count, 16),
            [count, 7] => (count, 7),
            _ => {
                let sizes: Vec<String> = shape.iter().map(ToString::to_string).collect();
                let comma = if shape.len() == 1 { "," } else { "" };
                return Err(fault(&format!("the shape ({}{comma})", sizes.join(", "))));
            }
        };
        if value("fortran_order").is_some_and(|text| text.starts_with("True")) {
            return Err(Error::Invalid(
                "found an array in the order of Fortran, expected that of C: save numpy.ascontiguousarray(poses)"
                    .to_owned(),
            ));
        }
        Ok(Self { count, width, is_double, is_big_endian })
    }

    /// Returns the header of the table that has these rows; lengths are metres.
    pub fn header(&self) -> &'static str {
        if self.width == 7 {
            "x_m,y_m,z_m,qw,qx,qy,qz"
        } else {
            "m00,m01,m02,m03_m,m10,m11,m12,m13_m,m20,m21,m22,m23_m"
        }
    }

    /// Reads the row with this number, from 1: as many numbers as that header has names, and zeros.
    ///
    /// # Errors
    /// Where the file ends before, and for a matrix whose last row is not 0, 0, 0, 1.
    pub fn row(&self, number: usize, input: &mut dyn Read) -> Result<Numbers, Error> {
        let mut bytes = [0; 16 * 8];
        let size = if self.is_double { 8 } else { 4 };
        let bytes = &mut bytes[..self.width * size];
        input.read_exact(bytes).map_err(|fault| match fault.kind() {
            ErrorKind::UnexpectedEof => {
                Error::Invalid(format!("found the end of the file, expected pose {number} of {}", self.count))
            }
            _ => Error::Invalid(fault.to_string()),
        })?;
        if self.is_big_endian {
            bytes.chunks_exact_mut(size).for_each(<[u8]>::reverse);
        }
        let double = |part: &[u8]| match part {
            [a, b, c, d] => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
            [a, b, c, d, e, f, g, h] => f64::from_le_bytes([*a, *b, *c, *d, *e, *f, *g, *h]),
            _ => f64::NAN,
        };
        let mut values = [0.0; 16];
        let values = &mut values[..self.width];
        values.iter_mut().zip(bytes.chunks_exact(size)).for_each(|(value, part)| *value = double(part));
        if let Some(bad) = values.iter().find(|value| !value.is_finite()) {
            return Err(Error::Invalid(format!("found {bad} in pose {number}, expected numbers")));
        }
        let (given, last) = values.split_at(self.width.min(12));
        if !last.is_empty() && last != [0.0, 0.0, 0.0, 1.0] {
            return Err(Error::Invalid(format!("found the last row {last:?} of pose {number}, expected [0, 0, 0, 1]")));
        }
        let mut row = [0.0; 12];
        row[..given.len()].copy_from_slice(given);
        Ok((row, given.len()))
    }
}

/// Reads all of these bytes of the head.
fn read(input: &mut dyn Read, bytes: &mut [u8]) -> Result<(), Error> {
    input.read_exact(bytes).map_err(|fault| match fault.kind() {
        ErrorKind::UnexpectedEof => {
            Error::Invalid("found the end of the file in the head of the array, expected an array of numpy".to_owned())
        }
        _ => Error::Invalid(fault.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::Array;

    #[test]
    fn heads_are_read_or_refused_by_what_was_found() {
        let head = |kind: &str, order: &str, shape: &str| {
            Array::of(&format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}   \n"))
        };
        let fault =
            |kind: &str, order: &str, shape: &str| head(kind, order, shape).err().map(|error| error.to_string());
        let array = head("<f8", "False", "(3, 4, 4)").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((array.count, array.width), (3, 16));
        assert!(head(">f4", "False", "(1000000, 7)").is_ok());
        assert!(
            fault("<f8", "False", "(4, 4)").is_some_and(|text| text.starts_with("found the shape (4, 4), expected"))
        );
        assert!(fault("<f8", "False", "(7,)").is_some_and(|text| text.starts_with("found the shape (7,), expected")));
        assert!(fault("<i8", "False", "(3, 7)").is_some_and(|text| text.contains("type `<i8`")));
        assert!(fault("<f8", "True", "(3, 7)").is_some_and(|text| text.contains("ascontiguousarray")));
        assert!(Array::of("{'descr': [('x', '<f8')], 'shape': (3,)}").is_err());
    }

    #[test]
    fn rows_are_doubles_and_the_last_row_of_a_matrix_is_checked() {
        let array = Array { count: 2, width: 7, is_double: true, is_big_endian: true };
        let values = [0.1, -2.0, 1e-7, 1.0, 0.0, 0.0, 0.0];
        let bytes: Vec<u8> = values.iter().flat_map(|value: &f64| value.to_be_bytes()).collect();
        let (row, count) = array.row(1, &mut bytes.as_slice()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(row[..count], values);
        let short = array.row(2, &mut &bytes[..50]).err().map(|error| error.to_string());
        assert_eq!(short.as_deref(), Some("found the end of the file, expected pose 2 of 2"));
        let matrix = Array { count: 1, width: 16, is_double: false, is_big_endian: false };
        let zeros = [0; 64];
        let fault = matrix.row(1, &mut zeros.as_slice()).err().map(|error| error.to_string());
        assert!(fault.is_some_and(|text| text.contains("expected [0, 0, 0, 1]")));
    }
}
