//! Answers as arrays of numpy: written as they come, one file for each array beside the output, and put together at the end, so that
//! memory stays flat. The arrays are those of `looproot.Batch` in Python.

use super::npy::MAGIC;
use looproot::internal::error::Error;
use looproot::internal::mechanism::Solution;
use std::fs::File;
use std::io::{BufReader, BufWriter, Write, copy};
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Longest word of a status or proof, in characters: `rounded-data`, `self-motion`, `unsupported`.
const WORD: usize = 12;
/// The head of an array ends at a multiple of this.
const ALIGNED: usize = 64;

/// One array, whose bytes wait in a file.
struct Column {
    name: &'static str,
    kind: String,
    /// The shape behind the number of rows.
    tail: Vec<usize>,
    rows: usize,
    path: PathBuf,
    file: BufWriter<File>,
}

impl Column {
    fn new(output: &Path, name: &'static str, kind: &str, tail: &[usize]) -> std::io::Result<Self> {
        let mut path = output.as_os_str().to_owned();
        path.push(format!(".{name}.part"));
        let path = PathBuf::from(path);
        let file = BufWriter::new(File::create(&path)?);
        Ok(Self { name, kind: kind.to_owned(), tail: tail.to_vec(), rows: 0, path, file })
    }

    fn push(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.rows += 1;
        self.file.write_all(bytes)
    }

    /// Adds a word of at most [`WORD`] characters, as numpy keeps text: four bytes a character.
    fn push_word(&mut self, word: &str) -> std::io::Result<()> {
        let mut bytes = [0; 4 * WORD];
        for (place, letter) in word.chars().take(WORD).enumerate() {
            bytes[4 * place..4 * place + 4].copy_from_slice(&u32::from(letter).to_le_bytes());
        }
        self.push(&bytes)
    }

    fn head(&self) -> Vec<u8> {
        let sizes: Vec<String> = std::iter::once(&self.rows).chain(&self.tail).map(ToString::to_string).collect();
        head(&self.kind, &format!("({},)", sizes.join(", ")))
    }
}

/// Returns what stands before the numbers of an array.
fn head(kind: &str, shape: &str) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    let text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    // Behind the two bytes of the version and the two of the length stand the text and the end of its line.
    let whole = (bytes.len() + 4 + text.len() + 1).next_multiple_of(ALIGNED);
    let length = whole - bytes.len() - 4;
    bytes.extend([1, 0]);
    // A head has some hundred bytes.
    bytes.extend(u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes());
    bytes.extend(format!("{text:<0$}\n", length - 1).bytes());
    bytes
}

impl Drop for Column {
    fn drop(&mut self) {
        // What was put together, or given up, is not left beside the output; a file that is gone is no fault.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// The arrays of an answer.
pub struct Arrays {
    output: PathBuf,
    columns: Vec<Column>,
    names: Vec<String>,
    has_limits: bool,
    poses: i64,
    modes: i64,
    failed: Vec<(i64, String)>,
}

/// The places of the columns.
const Q: usize = 0;
const OFFSETS: usize = 1;
const CERTIFIED: usize = 2;
const NEAR: usize = 3;
const WITHIN: usize = 4;
const STATUS: usize = 5;
const PROOF: usize = 6;
const SELF_MOTION: usize = 7;

impl Arrays {
    /// Begins the arrays of an arm whose joint variables have these names.
    pub fn create(output: &Path, names: &[String], has_limits: bool) -> Result<Self, Error> {
        let text = format!("<U{WORD}");
        let column = |name, kind: &str, tail: &[usize]| Column::new(output, name, kind, tail);
        let columns = || -> std::io::Result<Vec<Column>> {
            Ok(vec![
                column("q", "<f8", &[names.len()])?,
                column("offsets", "<i8", &[])?,
                column("certified", "|b1", &[])?,
                column("near", "|b1", &[])?,
                column("within_limits", "|b1", &[])?,
                column("status", &text, &[])?,
                column("proof", &text, &[])?,
                column("self_motion", "<i8", &[])?,
            ])
        };
        let columns = columns().map_err(|fault| io(output, &fault))?;
        let mut arrays = Self {
            output: output.to_owned(),
            columns,
            names: names.to_vec(),
            has_limits,
            poses: 0,
            modes: 0,
            failed: Vec::new(),
        };
        arrays.columns[OFFSETS].push(&0_i64.to_le_bytes()).map_err(|fault| io(output, &fault))?;
        Ok(arrays)
    }

    /// Adds the answer to the next pose: its real solutions.
    pub fn add(&mut self, solution: &Solution) -> Result<(), Error> {
        let verdict = &solution.verdict;
        self.answer(solution, verdict.status.word(), verdict.proof.word(), verdict.self_motion)
            .map_err(|fault| io(&self.output, &fault))
    }

    fn answer(&mut self, solution: &Solution, status: &str, proof: &str, dimension: usize) -> std::io::Result<()> {
        for mode in solution.modes.iter().filter(|mode| mode.real) {
            let q: Vec<u8> = mode.q.iter().flat_map(|value| value.re.to_le_bytes()).collect();
            self.columns[Q].push(&q)?;
            self.columns[CERTIFIED].push(&[u8::from(mode.certified)])?;
            self.columns[NEAR].push(&[u8::from(mode.near)])?;
            if let Some(within) = mode.within_limits {
                self.columns[WITHIN].push(&[u8::from(within)])?;
            }
            self.modes += 1;
        }
        self.end_pose(status, proof, dimension)
    }

    fn end_pose(&mut self, status: &str, proof: &str, dimension: usize) -> std::io::Result<()> {
        self.poses += 1;
        self.columns[OFFSETS].push(&self.modes.to_le_bytes())?;
        self.columns[STATUS].push_word(status)?;
        self.columns[PROOF].push_word(proof)?;
        let dimension = i64::try_from(dimension).unwrap_or(i64::MAX);
        self.columns[SELF_MOTION].push(&dimension.to_le_bytes())
    }

    /// Adds a row that is no pose.
    pub fn refuse(&mut self, message: &str) -> Result<(), Error> {
        self.failed.push((self.poses, message.to_owned()));
        self.end_pose("error", "none", 0).map_err(|fault| io(&self.output, &fault))
    }

    /// Puts the file together.
    pub fn close(mut self) -> Result<(), Error> {
        self.joined().map_err(|fault| io(&self.output, &fault))
    }

    fn joined(&mut self) -> std::io::Result<()> {
        let mut archive = ZipWriter::new(BufWriter::new(File::create(&self.output)?));
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(true);
        for column in &mut self.columns {
            column.file.flush()?;
            archive.start_file(format!("{}.npy", column.name), options)?;
            archive.write_all(&column.head())?;
            copy(&mut BufReader::new(File::open(&column.path)?), &mut archive)?;
        }
        let texts = |texts: Vec<&str>| {
            let width = texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
            let mut bytes = Vec::new();
            for text in &texts {
                let letters = text.chars().map(u32::from).chain(std::iter::repeat(0)).take(width);
                bytes.extend(letters.flat_map(u32::to_le_bytes));
            }
            (format!("<U{width}"), texts.len(), bytes)
        };
        let failed: Vec<u8> = self.failed.iter().flat_map(|(index, _)| index.to_le_bytes()).collect();
        let errors = texts(self.failed.iter().map(|(_, text)| text.as_str()).collect());
        let names = texts(self.names.iter().map(String::as_str).collect());
        let list = |(kind, rows, bytes): (String, usize, Vec<u8>)| (kind, format!("({rows},)"), bytes);
        let small = [
            ("failed", list(("<i8".to_owned(), self.failed.len(), failed))),
            ("errors", list(errors)),
            ("names", list(names)),
            ("has_limits", ("|b1".to_owned(), "()".to_owned(), vec![u8::from(self.has_limits)])),
        ];
        for (name, (kind, shape, bytes)) in small {
            archive.start_file(format!("{name}.npy"), options)?;
            archive.write_all(&head(&kind, &shape))?;
            archive.write_all(&bytes)?;
        }
        archive.finish()?.flush()
    }
}

fn io(path: &Path, fault: &std::io::Error) -> Error {
    Error::Io { path: path.display().to_string(), message: fault.to_string() }
}
