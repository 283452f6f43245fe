//! Tells what people ask with the buttons, and what the feet run into, from contacts that bounce.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::buttons::Buttons;
use types::feet::Feet;
use types::sensor_data::Touch;

use crate::hysteresis::Debounced;

/// What was pressed so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct ButtonFilter {
    chest: Debounced,
    /// All three plates of the head at once.
    head: Debounced,
    /// For how long the head has been touched, in s.
    head_held: f32,
    bumpers: Feet<Debounced>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    touch: Input<Touch, "sensor_data.touch">,
    cycle_time: CycleTime,

    /// What is shorter than this is a bouncing contact.
    #[reflect(unit = "s", range = 0.0..)]
    bounce_time: Parameter<f32, "button_filter.bounce_time">,
    /// For how long all plates of the head must be touched.
    #[reflect(unit = "s", range = 0.0..)]
    head_hold_time: Parameter<f32, "button_filter.head_hold_time">,
}

#[context]
pub struct MainOutputs {
    /// What the buttons say, bouncing removed.
    buttons: MainOutput<Buttons>,
}

impl ButtonFilter {
    /// Nothing is pressed.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            chest: Debounced::default(),
            head: Debounced::default(),
            head_held: 0.0,
            bumpers: Feet::default(),
        })
    }

    /// Waits out the bouncing, then looks for what begins and what lasts.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let touch = context.touch;
        let step = context.cycle_time.since_last.as_secs_f32();
        let bounce_time = *context.bounce_time;
        let was_chest_pressed = self.chest.value();
        let is_chest_pressed = self.chest.update(touch.chest_button, step, bounce_time);
        let is_head_held = self.is_head_held(touch, step, bounce_time, *context.head_hold_time);
        let left = touch.left_foot_left || touch.left_foot_right;
        let right = touch.right_foot_left || touch.right_foot_right;
        let buttons = Buttons {
            is_chest_pressed: is_chest_pressed && !was_chest_pressed,
            is_head_held,
            bumpers: Feet {
                left: self.bumpers.left.update(left, step, bounce_time),
                right: self.bumpers.right.update(right, step, bounce_time),
            },
        };
        Ok(MainOutputs {
            buttons: buttons.into(),
        })
    }

    fn is_head_held(&mut self, touch: &Touch, step: f32, bounce_time: f32, hold_time: f32) -> bool {
        let is_touched = touch.head_front && touch.head_middle && touch.head_rear;
        let was_touched = self.head.value();
        if !self.head.update(is_touched, step, bounce_time) {
            self.head_held = 0.0;
            return false;
        }
        // The bouncing belongs to the touch.
        self.head_held += if was_touched { step } else { bounce_time };
        self.head_held >= hold_time
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::cycle_time;

    use super::*;

    fn node() -> ButtonFilter {
        ButtonFilter::new(CreationContext {}).unwrap()
    }

    /// One cycle of 12 ms.
    fn cycle(node: &mut ButtonFilter, touch: Touch) -> Buttons {
        let context = CycleContext {
            touch: &touch,
            cycle_time: cycle_time(12, 12),
            bounce_time: &0.03,
            head_hold_time: &1.0,
        };
        node.cycle(context).unwrap().buttons.value
    }

    fn chest(chest_button: bool) -> Touch {
        Touch {
            chest_button,
            ..Touch::default()
        }
    }

    fn head(plates: [bool; 3]) -> Touch {
        let [head_front, head_middle, head_rear] = plates;
        Touch {
            head_front,
            head_middle,
            head_rear,
            ..Touch::default()
        }
    }

    /// How many presses these samples of the chest button are.
    fn presses(samples: &[bool]) -> usize {
        let mut node = node();
        let buttons = samples
            .iter()
            .map(|sample| cycle(&mut node, chest(*sample)));
        buttons.filter(|buttons| buttons.is_chest_pressed).count()
    }

    #[test]
    fn a_long_press_of_the_chest_begins_once() {
        assert_eq!(presses(&[true; 100]), 1);
        let twice = [[true; 10], [false; 10], [true; 10], [false; 10]];
        assert_eq!(presses(twice.as_flattened()), 2);
    }

    #[test]
    fn a_bouncing_button_is_pressed_once() {
        let bounces = [[true, false].repeat(4), vec![true; 8]];
        let press = [&bounces[0][..], &bounces[1], &bounces[0], &[false; 8]].concat();
        assert_eq!(presses(&press), 1);
        assert_eq!(presses(&bounces[0]), 0);
    }

    #[test]
    fn the_head_is_held_after_its_time_until_it_is_released() {
        let mut node = node();
        let cycles = (1..200).find(|_| cycle(&mut node, head([true; 3])).is_head_held);
        let seconds = cycles.unwrap() as f32 * 0.012;
        assert!((1.0..1.03).contains(&seconds), "{seconds} s");
        cycle(&mut node, head([true, false, true]));
        let bounced = cycle(&mut node, head([true; 3]));
        assert!(bounced.is_head_held, "a plate that flickers is no release");
        for _ in 0..4 {
            cycle(&mut node, head([false; 3]));
        }
        assert!(!cycle(&mut node, head([true; 3])).is_head_held);
    }

    #[test]
    fn two_plates_are_not_the_head() {
        let mut node = node();
        assert!((0..200).all(|_| !cycle(&mut node, head([true, true, false])).is_head_held));
    }

    #[test]
    fn either_bumper_of_a_foot_counts_for_that_foot() {
        let touches = [
            Touch {
                right_foot_left: true,
                ..Touch::default()
            },
            Touch {
                right_foot_right: true,
                ..Touch::default()
            },
        ];
        for touch in touches {
            let mut node = node();
            assert!(!cycle(&mut node, touch).bumpers.right);
            let later = (0..4).map(|_| cycle(&mut node, touch)).last().unwrap();
            assert!(later.bumpers.right && !later.bumpers.left);
        }
    }
}
