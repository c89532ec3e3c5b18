//! Linkages in the plane, on the sphere and in space.

use super::arm::angle;
use super::model::Model;
use crate::algebra::number::Number;
use crate::catalogue::entry::InputValue;
use crate::catalogue::{Any, LinkageCase, LinkageFile, Options, SpaceFile, SphereCase, SphereFile, load_any};
use crate::derivation::{
    Watch, derive_in_space, derive_linkage, derive_on_sphere, trace, trace_in_space, trace_on_sphere, transfer,
};
use crate::error::{Error, Result};
use crate::kinematics::joint::Variable;
use crate::kinematics::linkage::Given;
use crate::linkage::space::platform_of;
use crate::mobility::solve_or_move;
use crate::report::certificate::certificate_of_linkage;
use crate::report::linkage_sweep::{Asked, Traced};
use crate::report::ring_derivation::{self, Named};
use crate::report::{
    linkage, linkage_derivation, linkage_mobility, linkage_sweep, ring_curve, space, space_sweep, sphere, sphere_sweep,
};
use crate::sweep::{Range, sweep_linkage, sweep_space, sweep_sphere};
use crate::view::drawable;
use serde_json::Value;
use std::sync::atomic::AtomicBool;

/// A linkage: bodies with points, and the joints between them.
pub struct Linkage {
    file: Kind,
}

enum Kind {
    Plane(Box<LinkageFile>),
    Sphere(Box<SphereFile>),
    Space(Box<SpaceFile>),
}

impl Linkage {
    /// Reads a linkage from a file or from the library.
    ///
    /// # Errors
    /// For a file or name that cannot be read, and for a mechanism that is no linkage.
    pub fn from_file(name: &str) -> Result<Self> {
        match load_any(name, &Options::default())? {
            Any::Linkage(file) => Ok(Self { file: Kind::Plane(file) }),
            Any::Sphere(file) => Ok(Self { file: Kind::Sphere(file) }),
            Any::Space(file) => Ok(Self { file: Kind::Space(file) }),
            other => Err(Error::Invalid(other.kind().unexpected("a linkage"))),
        }
    }

    /// Returns the line that names the linkage.
    #[must_use]
    pub fn title(&self) -> &str {
        match &self.file {
            Kind::Plane(file) => &file.heading.title,
            Kind::Sphere(file) => &file.heading.title,
            Kind::Space(file) => &file.heading.title,
        }
    }

    /// Returns the joints that have a value, with the kind of it, in the order of every `q`.
    #[must_use]
    pub fn joints(&self) -> Vec<(String, Variable)> {
        match &self.file {
            Kind::Plane(file) => {
                let joints = file.linkage.joints.iter().filter(|joint| !joint.is_gear());
                let kind = |is_distance: bool| if is_distance { Variable::Translation } else { Variable::Rotation };
                joints.map(|joint| (joint.name.clone(), kind(joint.is_prismatic()))).collect()
            }
            Kind::Sphere(file) => {
                file.linkage.joints.iter().map(|joint| (joint.name.clone(), Variable::Rotation)).collect()
            }
            Kind::Space(file) => {
                let kind = |is_distance: bool| if is_distance { Variable::Translation } else { Variable::Rotation };
                let joints = file.linkage.joints.iter();
                joints.filter_map(|joint| Some((joint.name.clone(), kind(joint.is_distance()?)))).collect()
            }
        }
    }

    /// Returns the names of the bodies.
    #[must_use]
    pub fn bodies(&self) -> Vec<String> {
        match &self.file {
            Kind::Plane(file) => file.linkage.bodies.iter().map(|body| body.name.clone()).collect(),
            Kind::Sphere(file) => file.linkage.bodies.iter().map(|body| body.name.clone()).collect(),
            Kind::Space(file) => file.linkage.bodies.iter().map(|body| body.name.clone()).collect(),
        }
    }

    /// Returns the values of joints, radians or metres, as exact inputs.
    fn values(&self, given: &[(String, f64)]) -> Result<Vec<(String, InputValue)>> {
        let joints = self.joints();
        let one = |(name, value): &(String, f64)| {
            if !value.is_finite() {
                return Err(Error::Invalid(format!("found {value} as the input {name}, expected a finite number")));
            }
            let slides = joints.iter().any(|(own, kind)| own == name && *kind == Variable::Translation);
            let value =
                if slides { InputValue::Distance(Number::from_f64(*value)) } else { InputValue::Angle(angle(*value)) };
            Ok((name.clone(), value))
        };
        given.iter().map(one).collect()
    }

    /// Returns the document of `looproot solve --json --scene` with these values of joints in place of those of the file, or
    /// beside them: radians and metres. Complex assemblies are listed where they are asked for.
    ///
    /// # Errors
    /// For unknown joints, values that are not finite, too few or too many inputs, and linkages that are not solved.
    pub fn solve(&self, given: &[(String, f64)], complex: bool) -> Result<Value> {
        let mut document = match &self.file {
            Kind::Plane(file) => {
                let case = self.plane_case(file, given)?;
                let asked = crate::linkage::assembly::Asked { complex, stop: &AtomicBool::new(false), near: None };
                let answer = solve_or_move(file, &case, asked)?;
                linkage::json(file, &[linkage::result(file, &case, 1, &answer, complex)])
            }
            Kind::Sphere(file) => {
                let case = self.sphere_case(file, given)?;
                let answer = crate::linkage::sphere::solve(&file.linkage, &case.given, file.exact && case.exact)?;
                sphere::json(file, &[sphere::result(file, &case, 1, &answer, complex)])
            }
            Kind::Space(file) => {
                let case = file.case_at(&self.values(given)?)?;
                let answer = crate::linkage::space::solve(&file.linkage, &case.given, file.exact && case.exact)?;
                space::json(file, &[space::result(file, &case, 1, &answer, complex)])
            }
        };
        drawable(&mut document)?;
        Ok(document)
    }

    /// Returns the certificate of the answer with these values of joints in place of those of the file, or beside them, which
    /// [`crate::verify`] and `verify/verify.py` check: docs/certificate.md.
    ///
    /// # Errors
    /// As [`Linkage::solve`], and [`Error::Unsupported`] with the reason for an answer of which there is no certificate: of linkages in
    /// the plane with rational numbers there are some.
    pub fn certificate(&self, given: &[(String, f64)]) -> Result<Value> {
        let none = |reason: &str| Error::Unsupported(format!("there is no certificate: {reason}"));
        let Kind::Plane(file) = &self.file else {
            return Err(none("linkages on the sphere and in space are not covered"));
        };
        let case = self.plane_case(file, given)?;
        let asked = crate::linkage::assembly::Asked { complex: true, stop: &AtomicBool::new(false), near: None };
        let answer = solve_or_move(file, &case, asked)?;
        certificate_of_linkage(file, 1, &case, &answer).map_err(|reason| none(&reason))
    }

    fn plane_case(&self, file: &LinkageFile, given: &[(String, f64)]) -> Result<LinkageCase> {
        file.case_at(&self.values(given)?)
    }

    fn sphere_case(&self, file: &SphereFile, given: &[(String, f64)]) -> Result<SphereCase> {
        file.case_at(&self.values(given)?)
    }

    /// Returns the document of `looproot sweep --json --scene`: all branches while a joint runs through a range, the curve of a
    /// point `BODY.POINT` among them where one is named.
    ///
    /// # Errors
    /// For unknown joints and points, and as [`Linkage::solve`].
    pub fn sweep(&self, joint: &str, range: Range, traced: Option<&str>) -> Result<Value> {
        let number = self.number(joint)?;
        let mut document = match &self.file {
            Kind::Plane(file) => {
                let traced = traced.map(|name| file.point(name)).transpose()?;
                let traced = traced.map(|(body, name, place)| Traced {
                    body,
                    name: format!("{}.{name}", file.linkage.bodies[body].name),
                    place,
                });
                let found = sweep_linkage(&file.linkage, file.given(&file.cases[0]), number, range, || ())?;
                linkage_sweep::json(Asked { file, traced: traced.as_ref() }, &found)
            }
            Kind::Sphere(file) => {
                let traced = traced.map(|name| file.point(name)).transpose()?;
                let traced = traced
                    .map(|(body, name, place)| (body, format!("{}.{name}", file.linkage.bodies[body].name), place));
                let case = &file.cases[0];
                let found = sweep_sphere(&file.linkage, (&case.given, file.exact && case.exact), number, range)?;
                sphere_sweep::json(file, traced.as_ref(), &found)
            }
            Kind::Space(file) => {
                let traced = traced.map(|name| file.point(name)).transpose()?;
                let traced = traced
                    .map(|(body, name, place)| (body, format!("{}.{name}", file.linkage.bodies[body].name), place));
                let found = sweep_space(file, number, range, || ())?;
                space_sweep::json(file, traced.as_ref(), &found)
            }
        };
        drawable(&mut document)?;
        Ok(document)
    }

    /// Returns the number of a joint that has a value.
    fn number(&self, joint: &str) -> Result<usize> {
        let found = match &self.file {
            Kind::Plane(file) => file.linkage.joints.iter().position(|own| own.name == joint && !own.is_gear()),
            Kind::Sphere(file) => file.linkage.joints.iter().position(|own| own.name == joint),
            Kind::Space(file) => file.linkage.joints.iter().position(|own| own.name == joint),
        };
        found.ok_or_else(|| {
            let known: Vec<String> = self.joints().into_iter().take(12).map(|(name, _)| name).collect();
            Error::Invalid(format!("found the unknown joint `{joint}`, expected one of {}", known.join(", ")))
        })
    }

    /// Returns the document of `looproot derive --json`: the closure polynomials of the groups, or on the sphere the transfer
    /// function where there is one.
    ///
    /// # Errors
    /// As [`Linkage::solve`].
    pub fn derive(&self, given: &[(String, f64)]) -> Result<Value> {
        match &self.file {
            Kind::Plane(file) => {
                let case = self.plane_case(file, given)?;
                let derivation = derive_linkage(&file.linkage, &case.given)?;
                Ok(linkage_derivation::json(file, 1, &derivation))
            }
            Kind::Sphere(file) => {
                let case = self.sphere_case(file, given)?;
                let input = case.given.iter().find_map(|given| given.joint);
                let input = input.ok_or_else(|| Error::Invalid("found no joint given, expected one".to_owned()))?;
                if let Ok(found) = transfer(&file.linkage, input) {
                    return Ok(sphere::transfer_json(file, 1, &found));
                }
                let derivation = derive_on_sphere(&file.linkage, &case.given)?;
                let file = SphereFile { cases: vec![case], ..(**file).clone() };
                Ok(ring_derivation::json(&Named::on_sphere(&file, 1), &derivation))
            }
            Kind::Space(file) => {
                let case = file.case_at(&self.values(given)?)?;
                if let Some(platform) = platform_of(file, &case)? {
                    let legs = platform.cases[0].clone();
                    return Model::new(platform).derive(&legs);
                }
                let derivation = derive_in_space(&file.linkage, &case.given)?;
                let file = SpaceFile { cases: vec![case], ..(**file).clone() };
                Ok(ring_derivation::json(&Named::in_space(&file, 1), &derivation))
            }
        }
    }

    /// Returns the document of `looproot derive --trace BODY.POINT --json`: the curve of a point as a polynomial.
    ///
    /// # Errors
    /// For an unknown point, and for curves that are not derived.
    pub fn trace(&self, point: &str) -> Result<Value> {
        match &self.file {
            Kind::Plane(file) => {
                let (body, name, place) = file.point(point)?;
                // The input runs; what else is given stays.
                let given: &[Given] = &file.cases[0].given;
                let curve = trace(&file.linkage, given, body, &place, &Watch::none())?;
                Ok(linkage_derivation::curve_json(file, 1, &file.linkage.bodies[body].name, name, &curve))
            }
            Kind::Sphere(file) => {
                let (body, name, place) = file.point(point)?;
                let found = trace_on_sphere(&file.linkage, &file.cases[0].given, body, &place, &Watch::none())?;
                Ok(sphere::trace_json(file, 1, (&file.linkage.bodies[body].name, name), &found))
            }
            Kind::Space(file) => {
                let (body, name, place) = file.point(point)?;
                let curve = trace_in_space(&file.linkage, &file.cases[0].given, body, &place, &Watch::none())?;
                let named = Named::in_space(file, 1);
                Ok(ring_curve::json(&named, (&file.linkage.bodies[body].name, name), &curve))
            }
        }
    }

    /// Returns the document of `looproot mobility --json`.
    ///
    /// # Errors
    /// For a configuration that does not close, and in space and on the sphere without one.
    pub fn mobility(&self) -> Result<Value> {
        let any = match &self.file {
            Kind::Plane(file) => Any::Linkage(file.clone()),
            Kind::Sphere(file) => Any::Sphere(file.clone()),
            Kind::Space(file) => Any::Space(file.clone()),
        };
        match linkage_mobility::ask(&any, self.title()) {
            Some(asked) => Ok(linkage_mobility::json(&asked?)),
            None => Err(in_space("mobility")),
        }
    }
}

fn in_space(what: &str) -> Error {
    Error::Unsupported(format!("{what} of linkages in space are not found yet"))
}
