//! `looproot verify`

use super::arguments::VerifyOptions;
use super::exit::{Exit, Fault, complain};
use super::output::print;
use looproot::internal::catalogue::{Chains, Options, load_any};
use looproot::internal::certificate::{Fault as Broken, check_all};
use looproot::internal::error::Error;
use std::fs::File;
use std::io::Read;

/// Largest file of certificates, bytes.
const LARGEST: u64 = 128 << 20;

/// Checks every certificate of a file.
pub fn run(options: &VerifyOptions) -> Result<Exit, Fault> {
    let path = &options.certificate;
    let text = text(path)?;
    // A certificate may be about a mechanism without poses and inputs.
    let read = Options { chains: Chains::Any, ..options.read.options() };
    let entry = options.file.as_ref().map(|file| load_any(file, &read)).transpose()?;
    let (mut lines, mut exit) = (String::new(), Exit::Complete);
    let read = check_all(&text, entry.as_ref(), |number, outcome| match outcome {
        Ok(holds) => {
            lines += &format!("{path}:{number}: holds: {holds}\n");
        }
        Err(fault) => {
            lines += &format!("{path}:{number}: {}\n", printable(&fault));
            exit = exit.max(Exit::NotProved);
        }
    });
    print(&lines)?;
    match read {
        Ok(()) => Ok(exit),
        Err(Broken::Unreadable(message) | Broken::Refused(message)) => {
            complain(&format!("{path}: {}", printable(&message)));
            Ok(Exit::Misuse)
        }
    }
}

/// Words in which texts of a certificate stand, in one line: a line break there would let it print lines of its own.
fn printable(words: &impl ToString) -> String {
    words.to_string().replace(char::is_control, "?")
}

fn text(path: &str) -> Result<String, Error> {
    let fail = |message: String| Error::Io { path: path.to_owned(), message };
    let file = File::open(path).map_err(|error| fail(error.to_string()))?;
    let mut bytes = Vec::new();
    file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|error| fail(error.to_string()))?;
    if bytes.len() as u64 > LARGEST {
        return Err(fail(format!("found more than {LARGEST} bytes")));
    }
    String::from_utf8(bytes).map_err(|_| fail("found bytes that are no UTF-8".to_owned()))
}
