//! Loads on a linkage: "coupler.P: 0, -10; rocker: 5".

use looproot::internal::error::Error;
use looproot::internal::linkage::loads::Load;

/// A body with its points.
pub type Named<'a, const K: usize> = (&'a str, Vec<(&'a str, [f64; K])>);

/// Reads loads on bodies: K components of a force at a point, M of a moment.
pub fn loads<const K: usize, const M: usize>(text: &str, bodies: &[Named<'_, K>]) -> Result<Vec<Load<K, M>>, Error> {
    text.split(';').filter(|part| !part.trim().is_empty()).map(|part| load(part.trim(), bodies)).collect()
}

fn load<const K: usize, const M: usize>(part: &str, bodies: &[Named<'_, K>]) -> Result<Load<K, M>, Error> {
    let short = |text: &str| text.chars().take(60).collect::<String>();
    let (name, numbers) = part.rsplit_once(':').ok_or_else(|| {
        Error::Invalid(format!("found the load `{}`, expected a body or BODY.POINT, a colon and numbers", short(part)))
    })?;
    let (name, numbers) = (name.trim(), numbers.trim());
    let wrong = |count: usize| {
        Error::Invalid(format!("found `{}` as the load on {}, expected {count} numbers", short(numbers), short(name)))
    };
    if let Some(body) = bodies.iter().position(|(own, _)| *own == name) {
        return Ok(Load::Moment { body, moment: list(numbers).ok_or_else(|| wrong(M))? });
    }
    let found = bodies.iter().enumerate().find_map(|(body, (own, points))| {
        let point = name.strip_prefix(own)?.strip_prefix('.')?;
        points.iter().find(|(name, _)| *name == point).map(|(_, at)| (body, *at))
    });
    let (body, at) = found.ok_or_else(|| {
        let points = |(own, points): &Named<'_, K>| {
            let own = (*own).to_owned();
            points.iter().map(|(name, _)| format!("{own}.{name}")).chain([own.clone()]).collect::<Vec<_>>()
        };
        let known: Vec<String> = bodies.iter().flat_map(points).take(12).collect();
        Error::Invalid(format!("found a load on `{}`, expected one of {}", short(name), known.join(", ")))
    })?;
    Ok(Load::Force { body, at, force: list(numbers).ok_or_else(|| wrong(K))? })
}

/// Reads as many numbers, separated by commas.
fn list<const N: usize>(text: &str) -> Option<[f64; N]> {
    let all: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    all?.try_into().ok()
}
