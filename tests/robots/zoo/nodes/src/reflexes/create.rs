//! Reads parameters whose structs must not be called like their path.

use framework::{MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Create;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    own: Parameter<u8, "self_.x">,
    perhaps: Parameter<Option<String>, "option.text">,
    many: Parameter<Vec<u8>, "vec.numbers">,
    nested: Parameter<u8, "a.b.$cycler_instance.x">,
    joined: Parameter<u8, "a_b.$cycler_instance.y">,
}

#[context]
pub struct MainOutputs {
    sum: MainOutput<usize>,
}

impl Create {
    pub fn new(_: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let numbers = [context.own, context.nested, context.joined].into_iter();
        let numbers = numbers
            .chain(context.many)
            .map(|number| usize::from(*number));
        let letters = context.perhaps.as_ref().map_or(0, String::len);
        Ok(MainOutputs {
            sum: (letters + numbers.sum::<usize>()).into(),
        })
    }
}
