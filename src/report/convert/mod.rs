//! Arms as files of other formats.

mod document;
mod opw;
mod urdf;

use crate::catalogue::entry::{Design, Entry};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Placement};

/// The formats that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A mechanism file.
    Toml,
    /// The same keys as JSON.
    Json,
    /// A DH table.
    Csv,
    /// A robot description.
    Urdf,
    /// The seven lengths of arms with an ortho-parallel base and a spherical wrist, as YAML.
    Opw,
}

impl Target {
    /// The formats by their names.
    pub const NAMED: [(&str, Self); 5] =
        [("toml", Self::Toml), ("json", Self::Json), ("csv", Self::Csv), ("urdf", Self::Urdf), ("opw", Self::Opw)];
}

/// An arm as a file of another format.
///
/// # Errors
/// [`Error::Unsupported`] for what the format cannot say.
pub fn converted(entry: &Entry, target: Target) -> Result<String> {
    let Design::Arm(chain) = &entry.design else {
        return Err(Error::Unsupported("conversion of what is no arm".to_owned()));
    };
    match target {
        Target::Toml => Ok(document::toml(&document::document(entry, chain))),
        Target::Json => Ok(format!("{:#}\n", document::document(entry, chain))),
        Target::Csv => table(chain),
        Target::Urdf => urdf::urdf(entry, chain),
        Target::Opw => opw::opw(entry, chain),
    }
}

/// A DH table.
fn table(chain: &Chain) -> Result<String> {
    let plain = [&chain.base, &chain.tool].into_iter().all(|placement| *placement == Placement::identity());
    let Geometry::Dh(joints) = &chain.geometry else {
        return Err(Error::Unsupported("a DH table of joints that are not in classic DH form".to_owned()));
    };
    if !plain {
        return Err(Error::Unsupported("a DH table of an arm with a base or a tool, which it cannot say".to_owned()));
    }
    let mut text = "type,a,alpha,d,theta0\n".to_owned();
    for joint in joints {
        if !joint.kind.is_plain() {
            return Err(Error::Unsupported(format!("a DH table with a joint {}", joint.kind.letter())));
        }
        let (a, d) = (document::number(&joint.a), document::number(&joint.d));
        let (alpha, theta0) = (document::angle(&joint.alpha), document::angle(&joint.theta0));
        text += &format!("{},{a},{alpha},{d},{theta0}\n", joint.kind.letter());
    }
    Ok(text)
}
