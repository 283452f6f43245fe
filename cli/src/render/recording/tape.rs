//! What a cycle depends on beside nodes and parameters, as statements that save it or give it back.

use proc_macro2::TokenStream;
use quote::quote;

use crate::model::CyclerModel;
use crate::model::cycler::OutputField;
use crate::model::frame::FrameField;
use crate::render::body::own;
use crate::render::spelling::ident;

/// Which way it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tape {
    Save,
    Load,
    /// Takes down the types.
    Describe,
}

/// One statement, or some, for each field of what nodes may touch.
pub(super) fn quote_tape(cycler: &CyclerModel, tape: Tape) -> TokenStream {
    // States stand first; nodes that are created anew may need them, too.
    let states = cycler.has_states().then(|| match tape {
        Tape::Save => quote!(out.put(&self.cycler_state);),
        Tape::Load => quote!(self.cycler_state = from.take()?;),
        Tape::Describe => quote!(types.state(|body| &body.cycler_state);),
    });
    let fields = cycler.frame.iter().map(|field| match field {
        // The head of the frame; what nodes only write; what nobody can keep.
        FrameField::Cycle | FrameField::CaptureTime | FrameField::HardwareInterface => quote!(),
        FrameField::AdditionalOutputs => additional_outputs(cycler, tape),
        // Before everything else.
        FrameField::CyclerState | FrameField::Parameters | FrameField::Instance(_) => quote!(),
        FrameField::Historic => historic(cycler, tape),
        FrameField::Injections => match tape {
            Tape::Save => quote!(self.injections.save_injected(out);),
            Tape::Load => {
                quote!(self.injections.load_injected(from, &mut outside.injections)?;)
            }
            Tape::Describe => quote!(types.injections(|body| &body.injections);),
        },
        FrameField::Latest => latest(cycler, tape),
        FrameField::Own => outputs(cycler, tape, false, |output| output.setup, "current"),
        FrameField::Shared => outputs(cycler, tape, true, |output| output.setup, "current"),
        FrameField::Perception => perception(cycler, tape),
        FrameField::Previous => {
            let own = outputs(cycler, tape, false, |output| output.previous, "previous");
            let shared = outputs(cycler, tape, true, |output| output.previous, "previous");
            quote!(#own #shared)
        }
        FrameField::Procedures => procedures(cycler, tape),
        FrameField::Subscribed => match tape {
            Tape::Save => quote!(out.put(&self.subscribed);),
            Tape::Load => load_subscribed(cycler),
            Tape::Describe => quote!(types.subscribed(|body| &body.subscribed);),
        },
    });
    quote!(#states #(#fields)*)
}

/// Whether any of it lies in the slots.
pub(super) fn uses_slots(cycler: &CyclerModel) -> bool {
    let mut outputs = cycler.outputs.iter();
    outputs.any(|output| output.shared && (output.setup || output.previous))
}

/// Whether any of it is of the cycle whose number it has.
pub(super) fn uses_cycle(cycler: &CyclerModel) -> bool {
    let mut outputs = cycler.additional_outputs.iter();
    outputs.any(|output| output.setup)
}

/// Those that setup nodes fill: in a replay nobody else does.
fn additional_outputs(cycler: &CyclerModel, tape: Tape) -> TokenStream {
    let outputs = cycler.additional_outputs.iter();
    let statements = outputs.filter(|output| output.setup).map(|output| {
        let place = output.place.iter().map(|name| ident(name));
        let slot = quote!(additional_outputs #(.#place)*);
        match tape {
            Tape::Save => quote!(self.#slot.save(cycle, out);),
            Tape::Load => quote!(self.#slot.load(cycle, from)?;),
            Tape::Describe => {
                let text = output.place.join(".");
                quote!(types.additional_output(#text, |body| &body.#slot);)
            }
        }
    });
    statements.collect()
}

fn historic(cycler: &CyclerModel, tape: Tape) -> TokenStream {
    let outputs = cycler.historic().map(|output| {
        let name = ident(&output.name);
        match tape {
            Tape::Save => quote!(self.historic.#name.save(since, out);),
            Tape::Load => quote!(self.historic.#name.load(from)?;),
            Tape::Describe => {
                let text = &output.name;
                quote!(types.history(#text, |body| &body.historic.#name);)
            }
        }
    });
    outputs.collect()
}

fn latest(cycler: &CyclerModel, tape: Tape) -> TokenStream {
    let sources = cycler.latest.iter().map(|source| {
        let (instance, reader) = (&source.instance, ident(&source.reader));
        let writer = ident(&source.writer);
        foreign(tape, instance, &quote!(#reader), &writer)
    });
    sources.collect()
}

fn perception(cycler: &CyclerModel, tape: Tape) -> TokenStream {
    let Some(perception) = &cycler.perception else {
        return quote!();
    };
    let lanes = perception.lanes.iter().map(|lane| {
        let (instance, field) = (&lane.instance, ident(&lane.field));
        let writer = ident(&lane.writer);
        foreign(tape, instance, &quote!(perception.#field), &writer)
    });
    let merges = perception.interleavings.iter().map(|interleaving| {
        let order = ident(&interleaving.field);
        let lanes = interleaving.lanes.iter().map(|lane| ident(lane));
        quote!(self.perception.#order.merge([#(&self.perception.#lanes),*]);)
    });
    let merges = (tape == Tape::Load).then(|| quote!(#(#merges)*));
    quote!(#(#lanes)* #merges)
}

fn foreign(
    tape: Tape,
    instance: &str,
    input: &TokenStream,
    writer: &proc_macro2::Ident,
) -> TokenStream {
    match tape {
        Tape::Save => quote!(::framework::recorded::Foreign::save(&self.#input, out);),
        Tape::Load => quote! {
            ::framework::recorded::Foreign::load(
                &mut self.#input,
                from,
                &mut outside.#writer,
                &mut |cycle| stored.value(#instance, cycle),
            )?;
        },
        Tape::Describe => quote!(types.foreign(#instance, |body| &body.#input);),
    }
}

fn procedures(cycler: &CyclerModel, tape: Tape) -> TokenStream {
    let procedures = cycler.procedures.iter().map(|procedure| {
        let name = ident(&procedure.name);
        match tape {
            Tape::Save => quote!(self.procedures.#name.save(out);),
            Tape::Load => quote!(self.procedures.#name.load(from)?;),
            Tape::Describe => {
                let text = &procedure.name;
                quote!(types.procedure(#text, |body| &body.procedures.#name);)
            }
        }
    });
    procedures.collect()
}

/// Who listened when it was recorded, and who listens to the replay.
fn load_subscribed(cycler: &CyclerModel) -> TokenStream {
    let subscribed = own(cycler, "Subscribed");
    let flags = cycler.additional_outputs.iter().map(|output| {
        let flag = ident(&output.flag);
        // The name is asked for in any case: each answer is the next name's.
        quote!(#flag: wanted.next_one() || recorded.#flag,)
    });
    quote! {
        let recorded: #subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = #subscribed { #(#flags)* };
    }
}

/// Main outputs of this cycle or of the one before.
fn outputs(
    cycler: &CyclerModel,
    tape: Tape,
    shared: bool,
    is_kept: impl Fn(&OutputField) -> bool,
    of: &str,
) -> TokenStream {
    let kept = cycler.outputs.iter();
    let kept = kept.filter(|output| output.shared == shared && is_kept(output));
    let of = ident(of);
    let place = match (shared, tape) {
        (true, Tape::Describe) => quote!(outputs),
        (true, _) => quote!(slots.#of),
        (false, Tape::Describe) => quote!(body.own.#of()),
        (false, Tape::Save) => quote!(self.own.#of()),
        (false, Tape::Load) if of == "current" => quote!(self.own.both_to_load().0),
        (false, Tape::Load) => quote!(self.own.both_to_load().1),
    };
    let statements = kept.map(|output| {
        let name = ident(&output.name);
        match tape {
            Tape::Save => quote!(out.output(&#place.#name);),
            Tape::Load => quote!(#place.#name = from.take()?;),
            Tape::Describe => {
                let function = describe_output(shared, of == "current");
                let (text, holder) = (&output.name, ident(if shared { "outputs" } else { "body" }));
                quote!(types.#function(#text, |#holder| &#place.#name);)
            }
        }
    });
    statements.collect()
}

fn describe_output(shared: bool, is_current: bool) -> proc_macro2::Ident {
    ident(match (shared, is_current) {
        (false, true) => "output",
        (true, true) => "shared_output",
        (false, false) => "previous",
        (true, false) => "shared_previous",
    })
}
