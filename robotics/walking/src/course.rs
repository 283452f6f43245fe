//! Owns what the walk owes its heading: soles slip, so that the body turns otherwise than the feet do.

use std::f32::consts::{PI, TAU};

use framework::Reflect;
use serde::{Deserialize, Serialize};

use crate::parameters::CourseParameters;

/// Asked turns against those that the body made.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Course {
    /// Of the body when the stride began, in rad; `None` where nobody knows it.
    heading: Option<f32>,
    /// In rad.
    owed: f32,
}

impl Course {
    /// A stride that should have turned the body by `asked` rad ends with the body at this heading.
    pub fn end_stride(&mut self, asked: f32, heading: f32, parameters: &CourseParameters) {
        let heading = heading.is_finite().then_some(heading);
        if let (Some(before), Some(now)) = (self.heading, heading) {
            let turned = (now - before + PI).rem_euclid(TAU) - PI;
            let most = parameters.most.max(0.0);
            self.owed = (self.owed + asked - turned).clamp(-most, most);
        }
        self.heading = heading;
    }

    /// How much the feet have to turn so that the body turns by `asked` rad and makes good some of what is owed.
    pub fn turn_of_feet(&self, asked: f32, parameters: &CourseParameters) -> f32 {
        let turn = asked / parameters.effect + parameters.gain * self.owed;
        if turn.is_finite() { turn } else { asked }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMETERS: CourseParameters = CourseParameters {
        effect: 0.5,
        gain: 0.5,
        most: 0.2,
    };

    /// The feet's turn after strides that should have turned by 0.1 rad and ended at these headings.
    fn turn_after(headings: &[f32]) -> f32 {
        let mut course = Course::default();
        for heading in headings {
            course.end_stride(0.1, *heading, &PARAMETERS);
        }
        course.turn_of_feet(0.1, &PARAMETERS)
    }

    #[test]
    fn what_was_asked_and_not_turned_is_made_good_up_to_a_limit() {
        assert!((turn_after(&[0.0]) - 0.2).abs() < 1e-6);
        assert!((turn_after(&[0.0, 0.1]) - 0.2).abs() < 1e-6);
        assert!((turn_after(&[0.0, 0.04]) - 0.23).abs() < 1e-6);
        assert!((turn_after(&[0.0, 0.04, 0.08]) - 0.26).abs() < 1e-6);
        assert!((turn_after(&[0.0, -1.0]) - 0.3).abs() < 1e-6);
        assert!((turn_after(&[0.0, 1.0]) - 0.1).abs() < 1e-6);
    }

    #[test]
    fn headings_go_around() {
        assert!((turn_after(&[PI - 0.05, -PI + 0.05]) - 0.2).abs() < 1e-5);
    }

    #[test]
    fn who_does_not_know_the_heading_owes_nothing() {
        assert!((turn_after(&[f32::NAN, 1.0, f32::INFINITY, 2.0]) - 0.2).abs() < 1e-6);
        let nonsense = CourseParameters {
            effect: 0.0,
            gain: f32::NAN,
            most: f32::NAN,
        };
        let mut course = Course::default();
        course.end_stride(0.1, 0.0, &nonsense);
        course.end_stride(0.1, 0.0, &nonsense);
        assert_eq!(course.turn_of_feet(0.1, &nonsense), 0.1);
    }
}
