//! The four-bars of mechanism files as the data of certificates write them: of a loop, or of a linkage in the plane, whose input runs.

use super::chain::Around;
use super::linkage::{mirrored, square};
use super::sweep::FourBar;
use crate::algebra::ring::Ring;
use crate::catalogue::entry::{Design, Entry};
use crate::catalogue::{Any, LinkageFile};
use crate::kinematics::chain::{Geometry, JointKind};
use crate::kinematics::joint::{JointVariable, Variable};
use crate::kinematics::linkage::{Accuracy, Gaussian, Pair};
use crate::kinematics::motion::{Motion, dot};
use rug::Rational;
use serde_json::Value;

/// The reason for other mechanisms.
const OTHER: &str = "only loops RSSR and RSSP, four rotations about parallel axes or about axes through one point, and slider-cranks whose \
                     input turns beside the slide are covered";
/// The reason for irrational numbers.
const IRRATIONAL: &str = "four-bars with irrational numbers are not covered";

type Links = [Motion<Rational>; 4];

/// Returns the data of a loop of which a joint, counted from 1, turns.
///
/// # Errors
/// A clause that says why there is no certificate.
pub fn data_of_turning_loop(entry: &Entry, joint: usize) -> Result<Value, String> {
    let chain = match &entry.design {
        Design::Loop(chain) if !matches!(chain.geometry, Geometry::Screws { .. }) => chain,
        _ => return Err("only loops by constants of Denavit and Hartenberg are covered".to_owned()),
    };
    if entry.rounded {
        return Err(IRRATIONAL.to_owned());
    }
    let around = Around::<Rational>::of(chain, None).map_err(|fault| fault.to_string())?;
    let named = JointVariable::of(&chain.joint_kinds());
    let (mut joints, mut at) = (Vec::new(), None);
    for (variable, link) in named.iter().zip(&around.links) {
        let is_spherical = variable.kind == JointKind::Spherical;
        // The three angles of a spherical joint are one joint, and the link is behind the last one.
        if is_spherical && variable.turn != 3 {
            continue;
        }
        if variable.joint == joint && variable.variable == Variable::Rotation && variable.turn == 0 {
            at = Some(joints.len());
        }
        let letter = match variable.variable {
            _ if is_spherical => 'S',
            Variable::Rotation => 'R',
            Variable::Translation => 'P',
        };
        joints.push((letter, link.clone()));
    }
    joints.rotate_left(at.ok_or(OTHER)?);
    let (mut word, links): (String, Vec<Motion<Rational>>) = joints.into_iter().unzip();
    let mut links: Links = links.try_into().map_err(|_| OTHER)?;
    let is_backwards = !["RSSR", "RSSP", "RRRR", "RRRP"].contains(&word.as_str());
    if is_backwards {
        // The other way round the input turns backwards.
        word = word[..1].chars().chain(word[1..].chars().rev()).collect();
        links.reverse();
        links = links.each_ref().map(Motion::inverse);
    }
    let (is_slide, is_spherical) = (word.ends_with('P'), word.starts_with("RSS"));
    if !["RSSR", "RSSP", "RRRR", "RRRP"].contains(&word.as_str()) {
        return Err(OTHER.to_owned());
    }
    let mut bar = of_links(links, is_spherical, is_slide).ok_or(OTHER)?;
    if is_backwards {
        for y in [&mut bar.crank[1], &mut bar.place[1], &mut bar.axis[1]] {
            *y = Rational::from(-&*y);
        }
    }
    bar.written().ok_or_else(|| OTHER.to_owned())
}

/// Returns the four-bar of a loop of the input, the joints at A and B, and the output, which slides or turns.
fn of_links(links: Links, is_spherical: bool, is_slide: bool) -> Option<FourBar> {
    let is_flat = !is_spherical && has_parallel_axes(&links, is_slide);
    let links = match (is_spherical || is_flat, is_slide) {
        (true, _) => links,
        (false, false) => about_one_point(&links)?,
        (false, true) => return None,
    };
    let ([x, y, height], mut side) = (links[0].translation.clone(), links[1].translation.clone());
    let (b, ground) = (links[2].inverse().translation, links[3].inverse());
    let foot = if is_slide { b.clone() } else { [Rational::new(), Rational::new(), b[2].clone()] };
    let mut place = ground.apply(&foot);
    place[2] -= height;
    if is_flat {
        (side[2], place[2]) = (Rational::new(), Rational::new());
    }
    let across = Rational::from(b[0].square_ref()) + Rational::from(b[1].square_ref());
    Some(FourBar {
        crank: [x, y],
        coupler_squared: dot(&side, &side),
        axis: ground.rotation.map(|[_, _, z]| z),
        place,
        radius_squared: (!is_slide).then_some(across),
    })
}

/// Returns whether three axes are parallel, the fourth one is as well or slides across them, and nothing opens the loop along them.
fn has_parallel_axes(links: &Links, is_slide: bool) -> bool {
    let [first, rest @ ..] = links;
    let around = rest.iter().fold(first.clone(), |product, link| product.then_after(link));
    let is_along = |link: &Motion<Rational>| Rational::from(link.rotation[2][2].square_ref()) == 1;
    let is_last = if is_slide { links[2].rotation[2][2] == 0 } else { is_along(&links[2]) };
    let is_whole = around.rotation[2][2] == 1 && around.translation[2] == 0;
    is_along(&links[0]) && is_along(&links[1]) && is_last && is_whole
}

/// Returns the links between points of the axes at the distance 1 from the one point in which all axes meet; `None` if they do not, or if two
/// neighbours are parallel.
fn about_one_point(links: &Links) -> Option<Links> {
    let mut heights = Vec::new();
    for link in links {
        let [[_, _, u], [_, _, v], [_, _, w]] = &link.rotation;
        let [x, y, z] = &link.translation;
        let square = Rational::from(u.square_ref()) + Rational::from(v.square_ref());
        if square == 0 {
            return None;
        }
        let h = -(Rational::from(x * u) + Rational::from(y * v)) / square;
        if Rational::from(&h * u) != Rational::from(-x) || Rational::from(&h * v) != Rational::from(-y) {
            return None;
        }
        heights.push([z + Rational::from(&h * w), h]);
    }
    let is_one = (0..4).all(|k| heights[k][1] == heights[(k + 1) % 4][0]);
    let moved = |link: &Motion<Rational>| {
        let [[_, _, u], [_, _, v], [_, _, w]] = link.rotation.clone();
        Motion { translation: [u, v, w - 1], ..link.clone() }
    };
    is_one.then(|| links.each_ref().map(moved))
}

/// Returns the data of a linkage of which a joint turns, by its index.
///
/// # Errors
/// A clause that says why there is no certificate.
pub fn data_of_turning_linkage(file: &LinkageFile, joint: usize) -> Result<Value, String> {
    let (linkage, case) = (&file.linkage, file.cases.first().ok_or("there is no case")?);
    // The value of the input itself may be any angle.
    if file.accuracy(case) == Accuracy::Rounded {
        return Err(IRRATIONAL.to_owned());
    }
    if case.given.iter().any(|given| given.joint() != Some(joint)) {
        return Err("linkages with further given values are not covered".to_owned());
    }
    let other =
        || "only linkages of four bodies round one loop, whose input turns beside a slide, are covered".to_owned();
    if linkage.joints.len() != 4 || linkage.bodies.len() != 4 {
        return Err(other());
    }
    let (mut order, mut bodies) = (vec![joint], vec![linkage.joints[joint].of[1]]);
    for last in 0..3 {
        let body = bodies[last];
        let mut next = (0..4).filter(|k| !order.contains(k) && linkage.joints[*k].of.contains(&body));
        let (Some(next), None) = (next.next(), next.next()) else { return Err(other()) };
        order.push(next);
        bodies.extend(linkage.joints[next].of.iter().find(|one| **one != body));
    }
    let ([b, c, d, a], [input, second, third, output]) = (bodies.as_slice(), order.as_slice()) else {
        return Err(other());
    };
    let is_whole = linkage.joints[joint].of[0] == *a && (0..4).all(|body| bodies.contains(&body));
    let turns = |k: &&usize| matches!(linkage.joints[**k].pair, Pair::Revolute);
    if !is_whole || !order[..3].iter().all(|k| turns(&k)) {
        return Err(other());
    }
    let place = |k: &usize, body: &usize| {
        let joint = &linkage.joints[*k];
        &joint.at[usize::from(joint.of[1] == *body)]
    };
    let between = |body: &usize, from: &usize, to: &usize| place(to, body).sub(place(from, body));
    let (crank, side, arm, ground) =
        (between(b, input, second), between(c, second, third), between(d, output, third), between(a, input, output));
    let flat = |z: Gaussian| [z.re, z.im, Rational::new()];
    let (axis, place, radius_squared) = match &linkage.joints[*output].pair {
        Pair::Revolute => ([0, 0, 1].map(Rational::from), flat(ground), Some(square(&arm))),
        Pair::Prismatic { turn, along, .. } if linkage.joints[*output].of[0] == *a => {
            (flat(along.clone()), flat(ground.add(&turn.mul(&arm))), None)
        }
        Pair::Prismatic { turn, along, .. } => {
            let back = mirrored(turn);
            (flat(along.mul(&back)), flat(ground.add(&back.mul(&arm))), None)
        }
        Pair::Gear { .. } => return Err(other()),
    };
    let crank = [crank.re, crank.im];
    let bar = FourBar { crank, coupler_squared: square(&side), axis, place, radius_squared };
    bar.written().ok_or_else(other)
}

/// Returns whether a file has a joint that may be the input of the four-bar of these data.
pub(super) fn is_about(file: &Any, data: &Value) -> bool {
    let is_own = |found: Result<Value, String>| found.is_ok_and(|own| own == *data);
    match file {
        Any::Entry(entry) => {
            let joints = entry.chain().map_or(0, |chain| chain.joint_kinds().len());
            (1..=joints).any(|joint| is_own(data_of_turning_loop(entry, joint)))
        }
        Any::Linkage(file) => (0..file.linkage.joints.len()).any(|joint| is_own(data_of_turning_linkage(file, joint))),
        _ => false,
    }
}
