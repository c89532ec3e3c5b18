//! The destination of output, and checks before writing there.

use super::arguments::{Colour, OutputOptions};
use super::exit::Fault;
use looproot::internal::error::Error;
use rayon::{ThreadPool, ThreadPoolBuilder};
use serde_json::Value;
use std::cell::RefCell;
use std::fs::File;
use std::io::{BufWriter, IsTerminal, Write, stdout};
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

/// Size of the buffer of the output, bytes: a line of JSON has three thousand, and the system is called for some twenty of them.
const BUFFER: usize = 1 << 16;

/// Standard output or a file, and whether to colour it.
pub struct Output {
    /// The buffered writer; it has to be flushed when a reader waits.
    pub writer: Box<dyn Write>,
    /// Whether colours are used.
    pub colour: bool,
    /// Whether a terminal shows the output as it grows.
    pub is_terminal: bool,
    /// The place for a document that is read at once: it need not become text.
    pub document: Option<Slot>,
}

/// The place for a document.
pub type Slot = Rc<RefCell<Option<Value>>>;

impl Output {
    /// Opens the output. The input file is never overwritten.
    pub fn open(options: &OutputOptions, input: &str) -> Result<Self, Fault> {
        let is_terminal = options.output.is_none() && stdout().is_terminal();
        let writer: Box<dyn Write> = match &options.output {
            None => Box::new(BufWriter::with_capacity(BUFFER, stdout())),
            Some(path) => {
                let same = |a: &Path| Some(a.canonicalize().ok()? == path.canonicalize().ok()?);
                let fault = |message: String| Error::Io { path: path.display().to_string(), message };
                if same(Path::new(input)) == Some(true) {
                    return Err(fault("is the input, which is never changed".to_owned()).into());
                }
                let file = File::create(path).map_err(|error| fault(error.to_string()))?;
                Box::new(BufWriter::with_capacity(BUFFER, file))
            }
        };
        let wanted = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        let colour = match options.color {
            Colour::Auto => is_terminal && wanted,
            Colour::Always => true,
            Colour::Never => false,
        };
        Ok(Self { writer, colour, is_terminal, document: None })
    }

    /// Writes a text that is ready, as [`Self::open`] says.
    pub fn write(options: &OutputOptions, input: &str, text: &str) -> Result<(), Fault> {
        let mut output = Self::open(options, input)?;
        output.writer.write_all(text.as_bytes())?;
        output.writer.flush()?;
        Ok(())
    }
}

/// An output that can be read afterwards.
#[derive(Clone, Default)]
pub struct Memory {
    bytes: Rc<RefCell<Vec<u8>>>,
    document: Slot,
}

impl Memory {
    /// Returns an output that writes to the buffer.
    pub fn output(&self) -> Output {
        let writer = Box::new(self.clone());
        Output { writer, colour: false, is_terminal: false, document: Some(self.document.clone()) }
    }

    /// Returns the document that was written, as it is or as text.
    pub fn take(&self) -> serde_json::Result<Value> {
        self.document.take().map_or_else(|| serde_json::from_slice(&self.bytes.take()), Ok)
    }
}

impl Write for Memory {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.bytes.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Prints a finished text on standard output.
pub fn print(text: &str) -> Result<(), Fault> {
    let mut out = stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()?;
    Ok(())
}

/// Returns a thread pool; `None` stands for all cores.
#[cfg(not(target_family = "wasm"))]
pub fn pool(threads: Option<usize>) -> Result<Arc<ThreadPool>, Fault> {
    started(ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)))
}

/// Returns the pool of the current thread, which does all the work where there are no others, as in a browser. There can be only one of
/// it, and further commands of the process use it again.
#[cfg(target_family = "wasm")]
pub fn pool(_threads: Option<usize>) -> Result<Arc<ThreadPool>, Fault> {
    thread_local! {
        static POOL: RefCell<Option<Arc<ThreadPool>>> = const { RefCell::new(None) };
    }
    if let Some(pool) = POOL.with_borrow(Clone::clone) {
        return Ok(pool);
    }
    let pool = started(ThreadPoolBuilder::new().num_threads(1).use_current_thread())?;
    POOL.set(Some(Arc::clone(&pool)));
    Ok(pool)
}

fn started(builder: ThreadPoolBuilder) -> Result<Arc<ThreadPool>, Fault> {
    let pool = builder.build().map(Arc::new);
    pool.map_err(|error| Error::Invalid(format!("cannot start the threads: {error}")).into())
}
