//! The one error type.
/// e
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// u
    #[error("unsupported: {0}")]
    Unsupported(String),
}
impl Error {
    /// u
    pub fn unsupported(m: String) -> Self { Self::Unsupported(m) }
}
