//! `src/runtime.rs`: instances, what connects them, and how to create them.

mod instance;
mod stubs;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::layout::{self, comment, doc, empty_line};
use super::spelling::{bound, ident, path};
use crate::model::runtime::{Buffer, InstanceModel, Runtime, end};
use crate::model::{CyclerModel, RuntimeModel};
pub(super) use instance::quote_body_fields;
use instance::quote_instance;
use stubs::{quote_new_stubs, quote_remotes, quote_stubs};

/// One module for each cycler, and `create`.
pub(super) fn render_runtime(model: &RuntimeModel) -> String {
    let mut modules: Vec<&str> = model
        .cyclers
        .iter()
        .map(|cycler| cycler.module.as_str())
        .collect();
    modules.sort_unstable();
    let modules = modules.into_iter().map(ident);
    let (stubs, create) = (quote_stubs(&model.runtime), quote_create(model));
    let items = quote! {
        #(pub mod #modules;)*
        #stubs
        #create
    };
    let imported = ["crate::cyclers".to_owned(), "crate::databases".to_owned()];
    layout::rust_file(
        "Instances, what connects them, and how to create them.",
        &imported,
        items,
    )
}

fn quote_create(model: &RuntimeModel) -> TokenStream {
    let buffers = quote_buffers(model);
    let ends = quote_all_ends(model);
    let cyclers = model
        .runtime
        .instances
        .iter()
        .map(|instance| quote_instance(model, instance));
    let instances = model
        .runtime
        .instances
        .iter()
        .map(|instance| ident(&instance.variable));
    let access = model
        .runtime
        .instances
        .iter()
        .map(|instance| quote_access(model, instance));
    let robot = &model.runtime.robot;
    let bounds = model.runtime.hardware.iter().map(|one| bound(one));
    let hardware = ident(if model.runtime.uses_hardware {
        "hardware"
    } else {
        "_hardware"
    });
    let left_out = &model.runtime.left_out;
    let remotes = quote_remotes(&model.runtime);
    let paragraph = empty_line();
    let robot = quote! {
        ::framework::Robot {
            name: #robot,
            clock: start.clock.clone(),
            instances: vec![#(Box::new(#instances)),*],
            access: vec![#(#access),*],
            left_out: &[#(#left_out),*],
            remotes: #remotes,
            parameters: ::framework::LiveParameters::new(parameters, start.parameters, start.clock),
        }
    };
    let (about, created, create) = quote_answer(&model.runtime, &robot);
    quote! {
        #about
        pub fn create<Hardware>(
            #hardware: &::std::sync::Arc<Hardware>,
            start: ::framework::Start<crate::parameters::Parameters>,
        ) -> ::framework::Result<#created>
        where
            Hardware: #(#bounds +)* Send + Sync + 'static,
        {
            #buffers
            #ends
            #(#cyclers)*
            #paragraph
            #create
        }
    }
}

/// What `create` makes, in words, as a type and as its last statements.
fn quote_answer(runtime: &Runtime, robot: &TokenStream) -> (TokenStream, TokenStream, TokenStream) {
    let created = quote!(::framework::Robot<crate::parameters::Parameters>);
    let all = "All instances in manifest order, connected and ready for a driver";
    if runtime.stubs.is_empty() {
        return (doc(&format!("{all}.")), created, quote!(Ok(#robot)));
    }
    let about = doc(&format!("{all}, and the stubs of what is left out."));
    let stubs = quote_new_stubs(runtime);
    let paragraph = empty_line();
    (
        about,
        quote!((#created, Stubs)),
        quote!(#stubs #paragraph Ok((#robot, stubs))),
    )
}

/// One buffer for each instance that runs or is read, and one for the parameters.
fn quote_buffers(model: &RuntimeModel) -> TokenStream {
    let why = comment("Readers of the newest cycle on the left, queues of consumers on the right.");
    let buffers = model.runtime.buffers.iter().map(|buffer: &Buffer| {
        let writer = ident(&format!("{}_writer", buffer.variable));
        let readers = buffer.readers.iter().map(|reader| ident(reader));
        let consumers = buffer.consumers.iter().map(|consumer| ident(consumer));
        let windows = buffer.consumers.iter().map(|_| Literal::usize_unsuffixed(buffer.queue));
        quote! {
            let (#writer, [#(#readers),*], [#(#consumers),*]) = ::framework::buffer([#(#windows),*]);
        }
    });
    let reading = model
        .runtime
        .instances
        .iter()
        .filter(|instance| model.cycler_of(instance.id).has_parameters());
    let readers = reading.map(|instance| ident(&end("parameters", &instance.variable)));
    quote! {
        #why
        #(#buffers)*
        let (parameters, [#(#readers),*], []) =
            ::framework::buffer_of(|| start.parameters.clone(), []);
    }
}

/// What connects all instances with clients.
fn quote_all_ends(model: &RuntimeModel) -> TokenStream {
    let ends = model
        .runtime
        .instances
        .iter()
        .map(|instance| quote_ends(model, instance));
    let (paragraph, why) = (
        empty_line(),
        comment("What clients write, listen to and call."),
    );
    quote!(#paragraph #why #(#ends)*)
}

/// What connects an instance with clients.
fn quote_ends(model: &RuntimeModel, instance: &InstanceModel) -> TokenStream {
    let cycler = model.cycler_of(instance.id);
    let variable = &instance.variable;
    let injections = ident(&format!("{variable}_injections"));
    let injected = (!cycler.outputs.is_empty()).then(|| ident(&format!("{variable}_injected")));
    let subscriptions = quote_subscriptions(cycler, instance, |module, names| {
        let (module, names) = (ident(module), ident(names));
        quote!(#module::#names)
    });
    let procedures = instance.procedures.iter().map(|procedure| {
        let (caller, answerer) = (ident(&procedure.caller), ident(&procedure.answerer));
        quote!(let (#caller, #answerer) = ::framework::procedure();)
    });
    quote! {
        let (#injections, [#injected], []) = ::framework::buffer([]);
        #subscriptions
        #(#procedures)*
    }
}

/// What clients listen to, if there is anything; `shared` names the constant of a module.
pub(super) fn quote_subscriptions(
    cycler: &CyclerModel,
    instance: &InstanceModel,
    shared: impl Fn(&str, &str) -> TokenStream,
) -> Option<TokenStream> {
    if cycler.additional_outputs.is_empty() {
        return None;
    }
    let subscriptions = ident(&format!("{}_subscriptions", instance.variable));
    let names = if cycler.names_are_shared() {
        shared(&cycler.module, &cycler.additional_names)
    } else {
        let names = cycler.additional_outputs.iter().map(|output| {
            let own = output.names.get(instance.id.instance);
            own.unwrap_or(&output.names[0])
        });
        quote!(&[#(#names),*])
    };
    Some(quote!(let #subscriptions = ::framework::Subscriptions::new(#names);))
}

/// What clients listen to, nothing included.
pub(super) fn quote_subscriptions_of(
    cycler: &CyclerModel,
    instance: &InstanceModel,
) -> TokenStream {
    if cycler.additional_outputs.is_empty() {
        return quote!(::framework::Subscriptions::new(&[]));
    }
    let subscriptions = ident(&format!("{}_subscriptions", instance.variable));
    quote!(#subscriptions)
}

/// What clients may do with an instance.
fn quote_access(model: &RuntimeModel, instance: &InstanceModel) -> TokenStream {
    let cycler = model.cycler_of(instance.id);
    let InstanceModel { name, variable, .. } = instance;
    let subscriptions = quote_subscriptions_of(cycler, instance);
    let injections = ident(&format!("{variable}_injections"));
    let table = cycler.outputs.is_empty().then(|| {
        let table = database(cycler, "Injections");
        quote!(::<#table>)
    });
    let named = cycler.procedures.iter().zip(&instance.procedures);
    let procedures = named.map(|(procedure, ends)| {
        let (text, caller) = (&procedure.name, ident(&ends.caller));
        quote!((#text, Box::new(#caller)))
    });
    let procedures = if cycler.procedures.is_empty() {
        quote!(Vec::new())
    } else {
        quote!(vec![#(#procedures),*])
    };
    quote! {
        ::framework::Access {
            instance: #name,
            subscriptions: #subscriptions,
            injector: Box::new(::framework::Injector #table::new(#injections)),
            procedures: #procedures,
        }
    }
}

/// A type of a cycler's database.
fn database(cycler: &CyclerModel, name: &str) -> TokenStream {
    path(&format!("crate::databases::{}::{name}", cycler.module))
}
