//! `#[context]`: what a node sees of every kind, and how a test fills it.

#![expect(
    unreachable_pub,
    reason = "contexts are public, the nodes of a test are not"
)]

use std::sync::Arc;
use std::time::Duration;

use framework::testing::{self, AdditionalProbe, at_millis, cycle_time};
use framework::{Clear, Reflect, Result, context, procedure};
use serde::{Deserialize, Serialize};

/// Every kind, imported as a node file does.
mod node {
    use framework::{
        AdditionalOutput, CaptureTime, CycleTime, CyclerState, HardwareInterface, HistoricInput,
        Input, LatestInput, MainOutput, Parameter, PerceptionInput, PreviousInput, Procedure,
        RequiredInput, Result, Timestamp, context,
    };

    use super::{Image, Speaker};

    #[derive(serde::Deserialize, serde::Serialize)]
    pub struct Node {
        calls: u32,
    }

    #[context]
    pub struct CreationContext {
        /// In metres.
        radius: Parameter<f32, "ball.radius">,
        maximum: Parameter<Option<f32>, "ball.maximum?">,
        calls: CyclerState<u32, "calls">,
        hardware: HardwareInterface,
    }

    #[context]
    pub struct CycleContext {
        image: Input<Image, "image">,
        present: RequiredInput<Option<f32>, "present?">,
        everywhere: RequiredInput<f32, "Control", "height">,
        maybe: Input<Option<f32>, "maybe?">,
        option: Input<Option<f32>, "maybe">,
        other: Input<f32, "Control", "c.d">,
        latest: LatestInput<f32, "Control", "x">,
        latest_maybe: LatestInput<Option<f32>, "Control", "y?">,
        previous: PreviousInput<f32, "x">,
        past: HistoricInput<f32, "x">,
        past_maybe: HistoricInput<Option<f32>, "y?">,
        seen: PerceptionInput<f32, "VisionTop", "x">,
        seen_maybe: PerceptionInput<Option<f32>, "VisionTop", "y?">,
        parameter: Parameter<f32, "a.$cycler_instance.b">,
        parameter_maybe: Parameter<Option<f32>, "c?">,
        state: CyclerState<u32, "x">,
        state_read: CyclerState<&Option<f32>, "y">,
        time: CycleTime,
        additional: AdditionalOutput<Vec<f32>, "x">,
        call: Procedure<f32, bool, "walk">,
        hardware: framework::HardwareInterface,
        picture: MainOutput<Image>,
    }

    #[context]
    #[derive(Debug, Default)]
    pub struct MainOutputs {
        sum: MainOutput<f32>,
        captured_at: CaptureTime,
    }

    impl Node {
        pub fn new(context: CreationContext<impl Speaker>) -> Result<Self> {
            context.hardware.say("new");
            *context.calls += 1;
            let maximum: Option<&f32> = context.maximum;
            assert_eq!((context.radius, maximum), (&0.05, None));
            Ok(Self { calls: 0 })
        }

        pub fn cycle(&mut self, context: CycleContext<impl Speaker>) -> Result<MainOutputs> {
            self.calls += 1;
            context.hardware.say("cycle");
            *context.state += 1;
            context.picture.data.extend_from_slice(&context.image.data);
            if let Some(call) = context.call {
                let slow = *call.request() < 1.0;
                call.answer(slow);
            }
            let mut additional = context.additional;
            additional.fill_if_subscribed(|| vec![*context.parameter]);
            let option: &Option<f32> = context.option;
            let maybe: Option<&f32> = context.maybe;
            let state_read: &Option<f32> = context.state_read;
            let latest: f32 = context.latest.map_or(0.0, |latest| *latest.value);
            let latest_maybe: Option<Option<&f32>> =
                context.latest_maybe.map(|latest| latest.value);
            let past: Option<&f32> = context.past.get(Timestamp::ZERO);
            let past_maybe: Option<Option<&f32>> = context.past_maybe.get(context.time.start);
            let seen: f32 = context
                .seen
                .persistent
                .iter()
                .map(|(_, value)| *value)
                .sum();
            let seen_maybe = context
                .seen_maybe
                .transient
                .iter()
                .filter_map(|(_, value)| value);
            let options = [
                option.as_ref(),
                maybe,
                state_read.as_ref(),
                latest_maybe.flatten(),
                past,
                past_maybe.flatten(),
                context.parameter_maybe,
            ];
            let sum = options.into_iter().flatten().sum::<f32>()
                + seen_maybe.sum::<f32>()
                + seen
                + latest
                + *context.present
                + *context.everywhere
                + *context.other
                + *context.previous;
            Ok(MainOutputs {
                sum: sum.into(),
                captured_at: context.time.start.into(),
            })
        }
    }
}

#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Image {
    pub data: Vec<u8>,
}

/// What the node asks of the platform.
pub trait Speaker {
    fn say(&self, text: &str);
}

#[derive(Default)]
struct Silent;

impl Speaker for Silent {
    fn say(&self, _text: &str) {}
}

#[test]
fn a_node_sees_every_kind() -> Result<()> {
    let hardware = Arc::new(Silent);
    let mut calls = 0;
    let mut node = node::Node::new(node::CreationContext {
        radius: &0.05,
        maximum: None,
        calls: &mut calls,
        hardware: &hardware,
    })?;
    assert_eq!(calls, 1);
    let image = Image { data: vec![1, 2] };
    let mut picture = Image::default();
    let mut state = 0;
    let mut additional = AdditionalProbe::default();
    let (caller, mut answerer) = procedure::<f32, bool>();
    let pending = caller.call(0.5);
    answerer.take();
    let numbers = [(at_millis(0), &64.0)];
    let maybe_numbers = [(at_millis(3), None)];
    let outputs = node.cycle(node::CycleContext {
        image: &image,
        present: &1.0,
        everywhere: &2.0,
        maybe: Some(&4.0),
        option: &Some(8.0),
        other: &16.0,
        latest: testing::latest(at_millis(0), &32.0, at_millis(10)),
        latest_maybe: testing::latest(at_millis(0), None, at_millis(10)),
        previous: &0.5,
        past: testing::history(&numbers, at_millis(10), &1.0),
        past_maybe: testing::history(&maybe_numbers, at_millis(10), Some(&128.0)),
        seen: testing::perception(&[(at_millis(1), &256.0)], &[(at_millis(2), &9.0)]),
        seen_maybe: testing::perception(&[], &[(at_millis(2), None), (at_millis(3), Some(&512.0))]),
        parameter: &3.0,
        parameter_maybe: Some(&1024.0),
        state: &mut state,
        state_read: &Some(2048.0),
        time: cycle_time(10, 10),
        additional: additional.output(),
        call: answerer.call(),
        hardware: &hardware,
        picture: &mut picture,
    })?;
    assert_eq!(outputs.sum.value, 4095.5);
    assert_eq!(outputs.captured_at.0, at_millis(10));
    assert_eq!((state, &picture), (1, &image));
    assert_eq!(additional.value(), Some(&vec![3.0]));
    answerer.close();
    assert!(matches!(
        pending.wait_timeout(Duration::from_secs(1)),
        Some(Ok(true))
    ));
    Ok(())
}

#[test]
fn a_context_has_no_more_parameters_than_it_needs() {
    mod empty {
        use super::context;
        use framework::{CycleTime, HardwareInterface};

        #[context]
        pub struct CreationContext {}
        #[context]
        pub struct CycleContext {
            time: CycleTime,
        }
        #[context]
        pub struct MainOutputs {}

        pub mod with_hardware {
            use super::{HardwareInterface, context};

            #[context]
            pub struct CycleContext {
                hardware: HardwareInterface,
            }
        }
    }
    let _: empty::CreationContext = empty::CreationContext {};
    let _: empty::CycleContext = empty::CycleContext {
        time: cycle_time(0, 0),
    };
    let hardware = Arc::new(3_u8);
    let _: empty::with_hardware::CycleContext<'_, u8> = empty::with_hardware::CycleContext {
        hardware: &hardware,
    };
    assert_eq!(align_of::<empty::MainOutputs>(), 1);
    assert_eq!(align_of::<node::MainOutputs>(), 16);
}
