//! One node: its fields, and its file.

use std::fmt::Write as _;

/// A node of some cycler.
pub(crate) struct Node {
    pub(crate) name: String,
    pub(crate) fields: Vec<Field>,
    pub(crate) outputs: Vec<Output>,
}

/// What a node declares in its cycle context, but for outputs in place.
pub(crate) enum Field {
    Input {
        name: String,
        of: Output,
    },
    Required {
        name: String,
        of: Output,
    },
    /// The latest of another instance.
    Foreign {
        name: String,
        instance: &'static str,
        of: Output,
    },
    Perception {
        name: String,
        instance: &'static str,
        of: Output,
    },
    Historic {
        name: String,
        of: Output,
    },
    Parameter {
        name: String,
    },
    State {
        name: String,
    },
    /// A cycler state of another node.
    StateOf {
        name: String,
        node: String,
    },
    Additional {
        name: String,
    },
}

/// A main output.
#[derive(Clone)]
pub(crate) struct Output {
    pub(crate) name: String,
    pub(crate) kind: Type,
}

/// Of what type an output is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    /// `[f32; N]`, returned by value.
    Block(usize),
    /// `Option<[f32; 4]>`, always present.
    Maybe,
    /// `Vec<f32>`, written in place.
    List,
    /// `Vec<f32>`, returned by value: the node allocates it.
    ReturnedList,
}

/// How many numbers a node puts in a list.
pub(crate) const LIST: usize = 24;

impl Type {
    pub(crate) fn name(self) -> String {
        match self {
            Self::Block(length) => format!("[f32; {length}]"),
            Self::Maybe => "Option<[f32; 4]>".to_owned(),
            Self::List | Self::ReturnedList => "Vec<f32>".to_owned(),
        }
    }

    /// A number out of a `&T` that is called `value`.
    fn number(self, value: &str) -> String {
        match self {
            Self::Block(_) => format!("{value}[0]"),
            Self::Maybe => format!("{value}.map_or(0.0, |value| value[0])"),
            Self::List | Self::ReturnedList => {
                format!("{value}.first().map_or(0.0, |first| *first)")
            }
        }
    }
}

impl Field {
    fn declaration(&self, node: &str) -> String {
        match self {
            Self::Input { name, of } => {
                format!("{name}: Input<{}, \"{}\">", of.kind.name(), of.name)
            }
            Self::Required { name, of } => {
                format!(
                    "{name}: RequiredInput<{}, \"{}?\">",
                    of.kind.name(),
                    of.name
                )
            }
            Self::Foreign { name, instance, of } => {
                format!(
                    "{name}: Input<{}, \"{instance}\", \"{}\">",
                    of.kind.name(),
                    of.name
                )
            }
            Self::Perception { name, instance, of } => format!(
                "{name}: PerceptionInput<{}, \"{instance}\", \"{}\">",
                of.kind.name(),
                of.name
            ),
            Self::Historic { name, of } => {
                format!("{name}: HistoricInput<{}, \"{}\">", of.kind.name(), of.name)
            }
            Self::Parameter { name } => format!("{name}: Parameter<f32, \"{node}.{name}\">"),
            Self::State { name } => format!("{name}: CyclerState<f32, \"{node}.{name}\">"),
            Self::StateOf { name, node } => format!("{name}: CyclerState<&f32, \"{node}.{name}\">"),
            Self::Additional { name } => {
                format!("{name}: AdditionalOutput<[f32; 16], \"{node}.{name}\">")
            }
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::Input { .. } | Self::Foreign { .. } => "Input",
            Self::Required { .. } => "RequiredInput",
            Self::Perception { .. } => "PerceptionInput",
            Self::Historic { .. } => "HistoricInput",
            Self::Parameter { .. } => "Parameter",
            Self::State { .. } | Self::StateOf { .. } => "CyclerState",
            Self::Additional { .. } => "AdditionalOutput",
        }
    }

    /// Adds what it says to `sum`.
    fn read(&self) -> Option<String> {
        Some(match self {
            Self::Input { name, of } | Self::Foreign { name, of, .. } => {
                format!("sum += {};", of.kind.number(&format!("context.{name}")))
            }
            Self::Required { name, .. } => format!("sum += context.{name}[0];"),
            Self::Perception { name, of, .. } => {
                let number = of.kind.number("value");
                format!(
                    "for (_, value) in context.{name}.persistent {{ sum += {number}; }}\n\
                     for (_, value) in context.{name}.transient {{ sum += {number}; }}"
                )
            }
            Self::Historic { name, of } => {
                let number = of.kind.number("value");
                format!(
                    "sum += context.{name}.get(context.cycle_time.start).map_or(0.0, |value| {number});\n\
                     sum += context.{name}.get(before).map_or(0.0, |value| {number});"
                )
            }
            Self::Parameter { name } | Self::State { name } | Self::StateOf { name, .. } => {
                format!("sum += *context.{name};")
            }
            Self::Additional { .. } => return None,
        })
    }

    fn write(&self) -> Option<String> {
        match self {
            Self::State { name } => Some(format!("*context.{name} = 0.5 * sum;")),
            Self::Additional { name } => {
                Some(format!("context.{name}.fill_if_subscribed(|| [sum; 16]);"))
            }
            _ => None,
        }
    }
}

impl Node {
    pub(crate) fn structure(&self) -> String {
        let (first, rest) = self.name.split_at(1);
        first.to_uppercase() + rest
    }

    pub(crate) fn reads_time(&self) -> bool {
        self.fields
            .iter()
            .any(|field| matches!(field, Field::Historic { .. }))
    }

    /// The node's file.
    pub(crate) fn render(&self) -> String {
        let (in_place, by_value): (Vec<_>, Vec<_>) = self
            .outputs
            .iter()
            .partition(|output| output.kind == Type::List);
        let fields: Vec<_> = self
            .fields
            .iter()
            .map(|field| field.declaration(&self.name))
            .collect();
        let written = |outputs: &[&Output]| -> Vec<String> {
            let all = outputs.iter();
            all.map(|output| format!("{}: MainOutput<{}>", output.name, output.kind.name()))
                .collect()
        };
        let mut context = written(&in_place);
        context.extend(
            self.reads_time()
                .then(|| "cycle_time: CycleTime".to_owned()),
        );
        context.extend(fields);
        let (context, main_outputs) = (context.join(",\n"), written(&by_value).join(",\n"));
        let structure = self.structure();
        format!(
            "//! A node that is measured.\n\n\
             use framework::{{{}}};\nuse serde::{{Deserialize, Serialize}};\n\n\
             #[derive(Deserialize, Serialize)]\npub struct {structure} {{ bias: f32 }}\n\n\
             #[context]\npub struct CreationContext {{}}\n\n\
             #[context]\npub struct CycleContext {{ {context} }}\n\n\
             #[context]\npub struct MainOutputs {{ {main_outputs} }}\n\n\
             impl {structure} {{\n\
             pub fn new(_: CreationContext) -> Result<Self> {{ Ok(Self {{ bias: {:.2} }}) }}\n\n\
             #[cfg_attr(feature = \"called\", inline(never))]\n#[cfg_attr(feature = \"inlined\", inline)]\n\
             pub fn cycle(&mut self, {}: CycleContext) -> Result<MainOutputs> {{\n{}}}\n}}\n",
            self.imports(),
            self.bias(),
            self.argument(),
            self.body(&in_place, &by_value)
        )
    }

    /// A constant of its own, so that no two nodes are the same code.
    fn bias(&self) -> f64 {
        let digits: String = self.name.chars().filter(char::is_ascii_digit).collect();
        0.01 * digits.parse().unwrap_or(1.0)
    }

    fn imports(&self) -> String {
        let mut names: Vec<_> = self.fields.iter().map(Field::kind).collect();
        names.extend(["Result", "context"]);
        names.extend((!self.outputs.is_empty()).then_some("MainOutput"));
        names.extend(self.reads_time().then_some("CycleTime"));
        names.sort_unstable();
        names.dedup();
        names.join(", ")
    }

    fn argument(&self) -> &'static str {
        let fills = |field: &Field| matches!(field, Field::Additional { .. });
        if self.fields.iter().any(fills) {
            return "mut context";
        }
        match self.fields.is_empty() && self.outputs.iter().all(|output| output.kind != Type::List)
        {
            true => "_",
            false => "context",
        }
    }

    fn body(&self, in_place: &[&Output], by_value: &[&Output]) -> String {
        if let Some(sum) = self.sum_of_blocks() {
            return sum;
        }
        let mut text = "let mut sum = self.bias;\n".to_owned();
        if self.reads_time() {
            text += "let before = framework::Timestamp::from_nanos(context.cycle_time.start.as_nanos().saturating_sub(20_000));\n";
        }
        let mut lines: Vec<_> = self.fields.iter().filter_map(Field::read).collect();
        lines.push("sum *= 0.05;".to_owned());
        lines.extend(self.fields.iter().filter_map(Field::write));
        for output in in_place {
            lines.push(format!(
                "context.{}.extend_from_slice(&[sum; {LIST}]);",
                output.name
            ));
        }
        for line in lines {
            writeln!(text, "{line}").expect("a String");
        }
        let outputs: Vec<_> = by_value
            .iter()
            .map(|output| {
                let value = match output.kind {
                    Type::Block(length) => format!("[sum; {length}]"),
                    Type::Maybe => "Some([sum; 4])".to_owned(),
                    Type::List | Type::ReturnedList => format!("vec![sum; {LIST}]"),
                };
                format!("{}: {value}.into()", output.name)
            })
            .collect();
        text + &format!("Ok(MainOutputs {{ {} }})\n", outputs.join(", "))
    }

    /// The trivial nodes do what the floor does: one block of two.
    fn sum_of_blocks(&self) -> Option<String> {
        let [
            Field::Input { name: left, .. },
            Field::Input { name: right, .. },
            rest @ ..,
        ] = &self.fields[..]
        else {
            return None;
        };
        let [
            Output {
                name,
                kind: Type::Block(16),
            },
        ] = &self.outputs[..]
        else {
            return None;
        };
        let perceived: Vec<_> = rest
            .iter()
            .filter_map(|field| match field {
                Field::Perception { name, .. } => Some(name),
                _ => None,
            })
            .collect();
        if perceived.len() != rest.len() || left != "left" {
            return None;
        }
        let mut bias = format!("self.bias + {:.2}", self.bias());
        for name in perceived {
            write!(bias, " + context.{name}.persistent.len() as f32").expect("a String");
        }
        Some(format!(
            "// The constant keeps nodes apart that would be one function.\nlet bias = {bias};\nlet mut {name} = [0.0; 16];\n\
             for (index, value) in {name}.iter_mut().enumerate() {{\n\
             *value = 0.5 * context.{left}[index] + 0.25 * context.{right}[index] + bias;\n}}\n\
             Ok(MainOutputs {{ {name}: {name}.into() }})\n"
        ))
    }
}
