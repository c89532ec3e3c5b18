//! The four-bars of mechanism files as the data of certificates write them: of a loop, or of a linkage in the plane, whose input runs.

use super::chain::Around;
use super::linkage::{mirrored, square};
use super::spherical::data_of_turning_sphere;
use super::sweep::{FourBar, Output};
use crate::algebra::ring::Ring;
use crate::catalogue::entry::{Design, Entry};
use crate::catalogue::{Any, LinkageFile};
use crate::kinematics::chain::{Geometry, JointKind};
use crate::kinematics::joint::{JointVariable, Variable};
use crate::kinematics::linkage::{Accuracy, Gaussian, LinkageJoint, Pair};
use crate::kinematics::motion::{Motion, dot};
use rug::Rational;
use serde_json::Value;

/// The joints from the input on: A and B are in the middle. Of the last one A lies in a plane of the output.
const KINDS: [&str; 5] = ["RSSR", "RSSP", "RRRR", "RRRP", "RRPR"];
/// The reason for other mechanisms.
const OTHER: &str = "only loops RSSR and RSSP, four rotations about axes that are parallel or meet in one point, and three rotations with a \
                     slide in their plane are covered";
/// The reason for other linkages.
pub(super) const OTHER_LINKAGE: &str = "only linkages of four bodies round one loop with one slide at most are covered";
/// The reason for irrational numbers.
pub(super) const IRRATIONAL: &str = "four-bars with irrational numbers are not covered";

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
    let is_backwards = !KINDS.contains(&word.as_str());
    if is_backwards {
        // The other way round the input turns backwards.
        word = word[..1].chars().chain(word[1..].chars().rev()).collect();
        links.reverse();
        links = links.each_ref().map(Motion::inverse);
    }
    let bar = if KINDS.contains(&word.as_str()) { of_links(links, &word) } else { None };
    let mut bar = bar.ok_or(OTHER)?;
    if is_backwards {
        bar.mirror();
    }
    bar.written().ok_or_else(|| OTHER.to_owned())
}

/// Returns the four-bar of a loop of the input, the joints at A and B, and the output.
fn of_links(links: Links, word: &str) -> Option<FourBar> {
    let is_spherical = word.starts_with("RSS");
    let is_flat = !is_spherical && has_parallel_axes(&links, word);
    let links = if is_spherical || is_flat {
        links
    } else if word == "RRRR" {
        about_one_point(&links)?
    } else {
        return None;
    };
    let ([x, y, height], mut side) = (links[0].translation.clone(), links[1].translation.clone());
    let (last, ground) = (links[2].inverse(), links[3].inverse());
    let b = &last.translation;
    let foot = if word.ends_with('P') { b.clone() } else { [Rational::new(), Rational::new(), b[2].clone()] };
    let mut place = ground.apply(&foot);
    place[2] -= height;
    if is_flat {
        (side[2], place[2]) = (Rational::new(), Rational::new());
    }
    let coupler = dot(&side, &side);
    let output = match word {
        "RRPR" => {
            let p = links[1].then_after(&links[2]).inverse().translation;
            let offset = Rational::from(&p[0] * &last.rotation[1][2]) - Rational::from(&p[1] * &last.rotation[0][2]);
            Output::Plane { offset: offset.square() }
        }
        "RRRP" | "RSSP" => Output::Slide { coupler },
        _ => {
            let radius = Rational::from(b[0].square_ref()) + Rational::from(b[1].square_ref());
            Output::Circle { coupler, radius }
        }
    };
    Some(FourBar { crank: [x, y], axis: ground.rotation.map(|[_, _, z]| z), place, output })
}

/// Returns whether three axes are parallel, the fourth one is as well or slides across them, and nothing opens the loop along them.
fn has_parallel_axes(links: &Links, word: &str) -> bool {
    let [first, second, third, fourth] = links;
    let beside = if word == "RRPR" { second.then_after(third) } else { third.clone() };
    let around = first.then_after(second).then_after(third).then_after(fourth);
    // The slide is behind the second or the third link.
    let slide = word.find('P');
    let is_as_asked = |(k, link): (usize, &Motion<Rational>)| {
        let cosine = &link.rotation[2][2];
        if slide == Some(k) { *cosine == 0 } else { Rational::from(cosine.square_ref()) == 1 }
    };
    let is_whole = around.rotation[2][2] == 1 && around.translation[2] == 0;
    is_whole && (1..).zip([first, second, &beside]).all(is_as_asked)
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
    if file.accuracy(case) >= Accuracy::Squared {
        return Err(IRRATIONAL.to_owned());
    }
    if case.given.iter().any(|given| given.joint() != Some(joint)) {
        return Err("linkages with further given values are not covered".to_owned());
    }
    if linkage.bodies.len() != 4 {
        return Err(OTHER_LINKAGE.to_owned());
    }
    let of: Vec<[usize; 2]> = linkage.joints.iter().map(|joint| joint.of).collect();
    let forwards = round_loop(&of, joint, false).ok_or(OTHER_LINKAGE)?;
    // The other way round the input turns backwards.
    let is_backwards = linkage.joints[forwards.0[1]].is_prismatic();
    let (order, [b, c, d, a]) =
        if is_backwards { round_loop(&of, joint, true).ok_or(OTHER_LINKAGE)? } else { forwards };
    let word: String =
        order.iter().map(|joint| if linkage.joints[*joint].is_prismatic() { 'P' } else { 'R' }).collect();
    if order.iter().any(|joint| linkage.joints[*joint].is_gear()) || !KINDS.contains(&word.as_str()) {
        return Err(OTHER_LINKAGE.to_owned());
    }
    let [input, second, third, output] = order;
    let place = |joint: usize, body: usize| {
        let joint = &linkage.joints[joint];
        &joint.at[usize::from(joint.of[1] == body)]
    };
    let between = |body: usize, from: usize, to: usize| place(to, body).sub(place(from, body));
    let (crank, side, arm, ground) =
        (between(b, input, second), between(c, second, third), between(d, output, third), between(a, input, output));
    let flat = |z: Gaussian| [z.re, z.im, Rational::new()];
    let upright = [0, 0, 1].map(Rational::from);
    let coupler = square(&side);
    let (axis, place, output) = if let Some((along, turn)) = slide(&linkage.joints[output], a) {
        (flat(along), flat(ground.add(&turn.mul(&arm))), Output::Slide { coupler })
    } else if let Some((along, turn)) = slide(&linkage.joints[third], c) {
        let across = mirrored(&along).mul(&side.sub(&turn.mul(&arm))).im;
        (upright, flat(ground), Output::Plane { offset: across.square() / square(&along) })
    } else {
        (upright, flat(ground), Output::Circle { coupler, radius: square(&arm) })
    };
    let mut bar = FourBar { crank: [crank.re, crank.im], axis, place, output };
    if is_backwards {
        bar.mirror();
    }
    bar.written().ok_or_else(|| OTHER_LINKAGE.to_owned())
}

/// Returns the joints and bodies round one loop of four joints, whose bodies are given: first the second body of the input, or the first one.
pub(super) fn round_loop(joints: &[[usize; 2]], input: usize, is_backwards: bool) -> Option<([usize; 4], [usize; 4])> {
    let [from, to] = *joints.get(input).filter(|_| joints.len() == 4)?;
    let (first, last) = if is_backwards { (to, from) } else { (from, to) };
    let (mut order, mut bodies) = (vec![input], vec![last]);
    for step in 0..3 {
        let body = bodies[step];
        let mut next = (0..4).filter(|k| !order.contains(k) && joints[*k].contains(&body));
        let (Some(next), None) = (next.next(), next.next()) else { return None };
        order.push(next);
        let [one, other] = joints[next];
        bodies.push(if one == body { other } else { one });
    }
    let is_whole = bodies[3] == first && (0..4).all(|body| bodies.contains(&body));
    Some((order.try_into().ok()?, bodies.try_into().ok()?)).filter(|_| is_whole)
}

/// Returns the line of a slide in a body, and the rotation of the other body against it; `None` of joints that turn.
fn slide(joint: &LinkageJoint, body: usize) -> Option<(Gaussian, Gaussian)> {
    match &joint.pair {
        Pair::Prismatic { turn, along, .. } if joint.of[0] == body => Some((along.clone(), turn.clone())),
        Pair::Prismatic { turn, along, .. } => Some((along.mul(&mirrored(turn)), mirrored(turn))),
        _ => None,
    }
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
        Any::Sphere(file) => (0..file.linkage.joints.len()).any(|joint| is_own(data_of_turning_sphere(file, joint))),
        _ => false,
    }
}
