//! The calls that turn a body: create, wait, begin, run, finish, abandon, restore.

use proc_macro2::TokenStream;
use quote::quote;

use super::{argument, own, quote_shared};
use crate::model::CyclerModel;
use crate::model::frame::FrameField;
use crate::render::layout::comment;
use crate::render::spelling::{ident, path};

pub(super) fn quote_calls(cycler: &CyclerModel) -> TokenStream {
    [
        quote_create(cycler),
        quote_wait(cycler),
        quote_begin(cycler),
        quote_run(cycler),
        quote_finish(cycler),
        quote_abandon(cycler),
        quote_restore(cycler),
    ]
    .into_iter()
    .collect()
}

fn quote_create(cycler: &CyclerModel) -> TokenStream {
    let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
    let take = cycler
        .has_parameters()
        .then(|| quote!(self.parameters.take();));
    let state = own(cycler, "CyclerState");
    let state = cycler
        .has_states()
        .then(|| quote!(self.cycler_state = #state::default();));
    let (before, creation) = quote_creation(cycler);
    quote! {
        fn create(&mut self) -> ::framework::Result<()> {
            #take
            #state
            #before
            self.nodes = #nodes::new(#creation)?;
            Ok(())
        }
    }
}

/// What is needed before, and the argument that nodes are created from.
fn quote_creation(cycler: &CyclerModel) -> (TokenStream, TokenStream) {
    if cycler.creation.is_empty() {
        return (quote!(), quote!());
    }
    let creation = own(cycler, "Creation");
    let from_parameters =
        |field: &FrameField| matches!(field, FrameField::Parameters | FrameField::Instance(_));
    let parameters = cycler
        .creation
        .iter()
        .any(from_parameters)
        .then(|| quote!(let parameters = self.parameters.view().value();));
    let fields = cycler.creation.iter().map(|field| {
        let name = ident(field.name());
        match field {
            FrameField::Parameters => quote!(#name,),
            FrameField::Instance(part) => {
                let select = ident(&part.select);
                quote!(#name: (self.#select)(parameters),)
            }
            FrameField::CyclerState => quote!(#name: &mut self.#name,),
            _ => quote!(#name: &self.#name,),
        }
    });
    let before = quote! {
        #parameters
        let mut creation = #creation { #(#fields)* };
    };
    (before, quote!(&mut creation))
}

fn quote_wait(cycler: &CyclerModel) -> TokenStream {
    let sets_up = !cycler.setup.nodes.is_empty();
    let shared = quote_shared(cycler);
    let slots = argument("slots", sets_up && cycler.has_shared());
    let cycle = argument("cycle", sets_up);
    let take = cycler
        .has_parameters()
        .then(|| quote!(self.parameters.take();));
    let captures = cycler.has(&FrameField::CaptureTime);
    let forget = captures.then(|| quote!(self.capture_time = None;));
    let setup = sets_up.then(|| {
        let frame = quote_frame_call(cycler);
        quote! {
            let (nodes, mut frame) = #frame;
            nodes.setup(&mut frame)?;
        }
    });
    let captured = if captures {
        quote!(self.capture_time)
    } else {
        quote!(None)
    };
    quote! {
        fn wait(
            &mut self,
            #slots: ::framework::Slots<'_, #shared>,
            #cycle: ::framework::Cycle,
        ) -> ::framework::Result<Option<::framework::Timestamp>> {
            #take
            #forget
            #setup
            Ok(#captured)
        }
    }
}

fn quote_begin(cycler: &CyclerModel) -> TokenStream {
    let injects = !cycler.setup_outputs().is_empty();
    let shared = quote_shared(cycler);
    let slots = argument("slots", injects && cycler.has_shared());
    let cycle = argument("cycle", injects || cycler.perception.is_some());
    let takes = [
        (cycler.has_parameters(), "parameters"),
        (cycler.has(&FrameField::Injections), "injections"),
    ];
    let takes = takes
        .into_iter()
        .filter(|(needed, _)| *needed)
        .map(|(_, name)| name);
    let takes = takes
        .chain(cycler.latest.iter().map(|source| source.reader.as_str()))
        .map(ident);
    let perception = quote_consume(cycler);
    let subscribed = quote_subscribed(cycler);
    let procedures = cycler
        .procedures
        .iter()
        .map(|procedure| ident(&procedure.name));
    let inject = injects.then(|| {
        let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
        let frame = quote_frame_call(cycler);
        quote! {
            let (_, mut frame) = #frame;
            #nodes::inject(&mut frame);
        }
    });
    quote! {
        fn begin(&mut self, #slots: ::framework::Slots<'_, #shared>, #cycle: ::framework::Cycle) {
            #(self.#takes.take();)*
            #perception
            #subscribed
            #(self.procedures.#procedures.take();)*
            #inject
        }
    }
}

fn quote_consume(cycler: &CyclerModel) -> TokenStream {
    let Some(perception) = &cycler.perception else {
        return quote!();
    };
    let lanes = perception.lanes.iter().map(|lane| ident(&lane.field));
    let horizon = ident(&perception.horizon);
    let merges = perception.interleavings.iter().map(|interleaving| {
        let order = ident(&interleaving.field);
        let lanes = interleaving.lanes.iter().map(|lane| ident(lane));
        quote!(self.perception.#order.merge([#(&self.perception.#lanes),*]);)
    });
    quote! {
        self.perception.#horizon.consume(cycle.time.start, [#(&mut self.perception.#lanes),*]);
        #(#merges)*
    }
}

fn quote_subscribed(cycler: &CyclerModel) -> TokenStream {
    if cycler.additional_outputs.is_empty() {
        return quote!();
    }
    let subscribed = own(cycler, "Subscribed");
    let flags = cycler.additional_outputs.iter().map(|output| {
        let flag = ident(&output.flag);
        quote!(#flag: wanted.next_one(),)
    });
    quote! {
        if self.subscriptions.changed() {
            let mut wanted = self.subscriptions.wanted();
            self.subscribed = #subscribed { #(#flags)* };
        }
    }
}

fn quote_run(cycler: &CyclerModel) -> TokenStream {
    let runs = !cycler.cycle.nodes.is_empty();
    let shared = quote_shared(cycler);
    let slots = argument("slots", runs && cycler.has_shared());
    let cycle = argument("cycle", runs);
    let run = if runs {
        let frame = quote_frame_call(cycler);
        let injected = cycler
            .has(&FrameField::Injections)
            .then(|| quote!(|| self.injections.view().get().is_some()));
        quote! {
            if cycle.timed #injected {
                let (nodes, mut frame) = #frame;
                return nodes.cycle_closely(&mut frame);
            }
            let (nodes, mut frame) = #frame;
            nodes.cycle(&mut frame)
        }
    } else {
        quote!(Ok(()))
    };
    quote! {
        fn run(
            &mut self,
            #slots: ::framework::Slots<'_, #shared>,
            #cycle: ::framework::Cycle,
        ) -> ::framework::Result<()> {
            #run
        }
    }
}

fn quote_finish(cycler: &CyclerModel) -> TokenStream {
    let historic: Vec<_> = cycler.historic().collect();
    let shared_type = quote_shared(cycler);
    let shared = argument("shared", historic.iter().any(|output| output.shared));
    let cycle = argument("cycle", !historic.is_empty());
    let remember = historic.iter().map(|output| {
        let name = ident(&output.name);
        let value = if output.shared {
            quote!(&shared.#name)
        } else {
            quote!(&self.own.current().#name)
        };
        quote!(self.historic.#name.push(cycle.time.start, #value);)
    });
    let swap = cycler.has_own().then(|| quote!(self.own.swap();));
    let close = quote_close(cycler);
    quote! {
        fn finish(&mut self, #shared: &#shared_type, #cycle: ::framework::Cycle) {
            #(#remember)*
            #swap
            #close
        }
    }
}

fn quote_abandon(cycler: &CyclerModel) -> TokenStream {
    let close = quote_close(cycler);
    quote! {
        fn abandon(&mut self) {
            #close
        }
    }
}

fn quote_close(cycler: &CyclerModel) -> TokenStream {
    let procedures = cycler
        .procedures
        .iter()
        .map(|procedure| ident(&procedure.name));
    quote!(#(self.procedures.#procedures.close();)*)
}

fn quote_restore(cycler: &CyclerModel) -> TokenStream {
    if !cycler.nodes.iter().any(|node| node.restores) {
        let why = comment("The states of all nodes are whole.");
        return quote! {
            fn restore(&mut self) -> ::framework::Result<()> {
                #why
                Ok(())
            }
        };
    }
    let (before, creation) = quote_creation(cycler);
    quote! {
        fn restore(&mut self) -> ::framework::Result<()> {
            #before
            self.nodes.restore(#creation)
        }
    }
}

fn quote_frame_call(cycler: &CyclerModel) -> TokenStream {
    if cycler.has_shared() {
        quote!(self.frame(slots, cycle))
    } else {
        quote!(self.frame(cycle))
    }
}
