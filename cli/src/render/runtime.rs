//! `src/runtime.rs`: instances, what connects them, and how to create them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::instance::quote_duration;
use super::layout::{self, comment, doc, empty_line};
use super::spelling::{ident, path, place};
use crate::model::cycler::Source;
use crate::model::frame::FrameField;
use crate::model::names::snake_case;
use crate::model::runtime::{InstanceModel, end, queue};
use crate::model::{CyclerModel, RuntimeModel};

/// One module for each cycler, and `create`.
pub(super) fn render_runtime(model: &RuntimeModel) -> String {
    let mut modules: Vec<&str> = model.cyclers.iter().map(|cycler| cycler.module.as_str()).collect();
    modules.sort_unstable();
    let modules = modules.into_iter().map(ident);
    let create = quote_create(model);
    let items = quote! {
        #(pub mod #modules;)*
        #create
    };
    let imported = ["crate::cyclers".to_owned(), "crate::databases".to_owned()];
    layout::rust_file("Instances, what connects them, and how to create them.", &imported, items)
}

fn quote_create(model: &RuntimeModel) -> TokenStream {
    let buffers = quote_buffers(model);
    let ends = quote_all_ends(model);
    let cyclers = model.runtime.instances.iter().map(|instance| quote_instance(model, instance));
    let instances = model.runtime.instances.iter().map(|instance| ident(&instance.variable));
    let access = model.runtime.instances.iter().map(|instance| quote_access(model, instance));
    let robot = &model.runtime.robot;
    let bounds = model.runtime.hardware.iter().map(|bound| path(bound));
    let hardware = ident(if model.runtime.uses_hardware { "hardware" } else { "_hardware" });
    let about = doc("All instances in manifest order, connected and ready for a driver.");
    let paragraph = empty_line();
    quote! {
        #about
        pub fn create<Hardware>(
            #hardware: &::std::sync::Arc<Hardware>,
            start: ::framework::Start<crate::parameters::Parameters>,
        ) -> ::framework::Result<::framework::Robot<crate::parameters::Parameters>>
        where
            Hardware: #(#bounds +)* Send + Sync + 'static,
        {
            #buffers
            #ends
            #(#cyclers)*
            #paragraph
            Ok(::framework::Robot {
                name: #robot,
                clock: start.clock,
                instances: vec![#(Box::new(#instances)),*],
                access: vec![#(#access),*],
                parameters,
            })
        }
    }
}

/// One buffer for each instance, and one for the parameters.
fn quote_buffers(model: &RuntimeModel) -> TokenStream {
    let why = comment("Readers of the newest cycle on the left, queues of consumers on the right.");
    let buffers = model.runtime.instances.iter().map(|instance| {
        let writer = ident(&format!("{}_writer", instance.variable));
        let readers = instance.readers.iter().map(|reader| ident(reader));
        let consumers = instance.consumers.iter().map(|consumer| ident(consumer));
        let windows = instance.consumers.iter().map(|_| Literal::usize_unsuffixed(instance.queue));
        quote! {
            let (#writer, [#(#readers),*], [#(#consumers),*]) = ::framework::buffer([#(#windows),*]);
        }
    });
    let reading = model.runtime.instances.iter().filter(|instance| {
        model.cyclers[instance.id.cycler].has_parameters()
    });
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
    let ends = model.runtime.instances.iter().map(|instance| quote_ends(model, instance));
    let (paragraph, why) = (empty_line(), comment("What clients write, listen to and call."));
    quote!(#paragraph #why #(#ends)*)
}

/// What connects an instance with clients.
fn quote_ends(model: &RuntimeModel, instance: &InstanceModel) -> TokenStream {
    let cycler = &model.cyclers[instance.id.cycler];
    let variable = &instance.variable;
    let injections = ident(&format!("{variable}_injections"));
    let injected = (!cycler.outputs.is_empty()).then(|| ident(&format!("{variable}_injected")));
    let subscriptions = (!cycler.additional_outputs.is_empty()).then(|| {
        let subscriptions = ident(&format!("{variable}_subscriptions"));
        let names = cycler.additional_outputs.iter().map(|output| {
            output.names.get(instance.id.instance).unwrap_or(&output.names[0])
        });
        quote!(let #subscriptions = ::framework::Subscriptions::new(&[#(#names),*]);)
    });
    let procedures = cycler.procedures.iter().map(|procedure| {
        let caller = ident(&format!("{variable}_{}", procedure.name));
        let answerer = ident(&format!("{variable}_{}_answerer", procedure.name));
        quote!(let (#caller, #answerer) = ::framework::procedure();)
    });
    quote! {
        let (#injections, [#injected], []) = ::framework::buffer([]);
        #subscriptions
        #(#procedures)*
    }
}

/// An instance around its body.
fn quote_instance(model: &RuntimeModel, instance: &InstanceModel) -> TokenStream {
    let cycler = &model.cyclers[instance.id.cycler];
    let (module, name) = (ident(&cycler.module), ident(&cycler.name));
    let (constant, variable) = (ident(&instance.constant), ident(&instance.variable));
    let writer = ident(&format!("{}_writer", instance.variable));
    let creation = quote_creation(cycler, instance);
    let fields = quote_body_fields(model, cycler, instance);
    let paragraph = empty_line();
    let body = quote! {
        let #variable = ::framework::Cycler::new(
            #module::#constant,
            #module::#name { #fields },
            #writer,
            start.clock.clone(),
        );
    };
    quote!(#paragraph #creation #body)
}

/// What the nodes of an instance are created from.
fn quote_creation(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    if cycler.creation.is_empty() {
        return quote!();
    }
    let state = cycler.creation.contains(&FrameField::CyclerState).then(|| {
        let content = database(cycler, "CyclerState");
        quote!(let mut cycler_state = #content::default();)
    });
    let creation = database(cycler, "Creation");
    let fields = cycler.creation.iter().map(|field| {
        let name = ident(field.name());
        match field {
            FrameField::CyclerState => quote!(#name: &mut #name,),
            FrameField::HardwareInterface => quote!(#name: hardware,),
            FrameField::Instance(part) => {
                let path = place(&instance_path("start.parameters", &part.prefix, instance));
                quote!(#name: &#path,)
            }
            _ => quote!(#name: &start.parameters,),
        }
    });
    quote! {
        #state
        let mut creation = #creation { #(#fields)* };
    }
}

fn quote_body_fields(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
) -> TokenStream {
    let variable = &instance.variable;
    let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
    let creation = (!cycler.creation.is_empty()).then(|| quote!(&mut creation));
    let field = |needed: bool, name: &str, value: TokenStream| {
        let name = ident(name);
        needed.then(|| quote!(#name: #value,))
    };
    let end_of = |suffix: &str| {
        let end = ident(&format!("{variable}_{suffix}"));
        quote!(#end)
    };
    let has = |field: &FrameField| cycler.has(field);
    let default = |name: &str| {
        let content = database(cycler, name);
        quote!(#content::default())
    };
    let parameters = ident(&end("parameters", variable));
    let created = cycler.creation.contains(&FrameField::CyclerState);
    let fields = [
        field(has(&FrameField::AdditionalOutputs), "additional_outputs", default("AdditionalOutputs")),
        field(has(&FrameField::CaptureTime), "capture_time", quote!(None)),
        field(cycler.has_states() && !created, "cycler_state", default("CyclerState")),
        created.then(|| quote!(cycler_state,)),
        field(cycler.is_generic(), "hardware_interface", quote!(hardware.clone())),
        field(has(&FrameField::Historic), "historic", quote_historic(cycler, instance)),
        field(has(&FrameField::Injections), "injections", end_of("injected")),
        field(cycler.has_own(), "own", quote!(::framework::Swap::default())),
        field(cycler.has_parameters(), "parameters", quote!(#parameters)),
        field(has(&FrameField::Perception), "perception", quote_perception(model, cycler, instance)),
        field(has(&FrameField::Procedures), "procedures", quote_procedures(cycler, instance)),
        field(has(&FrameField::Subscribed), "subscribed", default("Subscribed")),
        field(has(&FrameField::Subscribed), "subscriptions", quote_subscriptions(cycler, instance)),
    ];
    let readers = cycler.latest.iter().map(|source| {
        let (field, reader) = (ident(&source.reader), ident(&end(&read(model, source).variable, variable)));
        quote!(#field: #reader,)
    });
    let selects = cycler.instance_parameters.iter().map(|part| {
        let select = ident(&part.select);
        let path = place(&instance_path("parameters", &part.prefix, instance));
        quote!(#select: |parameters| &#path,)
    });
    quote! {
        nodes: #nodes::new(#creation)?,
        #(#fields)*
        #(#readers)*
        #(#selects)*
    }
}

fn quote_historic(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    let historic = database(cycler, "Historic");
    let reach = quote_duration(instance.description.history);
    let outputs = cycler.historic().map(|output| {
        let name = ident(&output.name);
        quote!(#name: ::framework::History::new(#reach),)
    });
    quote!(#historic { #(#outputs)* })
}

fn quote_perception(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
) -> TokenStream {
    let Some(perception) = &cycler.perception else {
        return quote!();
    };
    let whole = database(cycler, "Perception");
    let orders = perception.interleavings.iter().map(|interleaving| ident(&interleaving.field));
    let lanes = perception.lanes.iter().map(|lane| {
        let producer = read(model, lane);
        let (name, queue) = (ident(&lane.field), ident(&queue(&producer.variable, &instance.variable)));
        let pending_timeout = quote_duration(producer.description.pending_timeout);
        quote!(#name: ::framework::Consumer::new(#queue, #pending_timeout),)
    });
    quote! {
        #whole {
            horizon: ::framework::Horizon::new(),
            #(#orders: ::framework::Interleaving::new(),)*
            #(#lanes)*
        }
    }
}

fn quote_procedures(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    let procedures = database(cycler, "Procedures");
    let answerers = cycler.procedures.iter().map(|procedure| {
        let name = ident(&procedure.name);
        let answerer = ident(&format!("{}_{}_answerer", instance.variable, procedure.name));
        quote!(#name: #answerer,)
    });
    quote!(#procedures { #(#answerers)* })
}

fn quote_subscriptions(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    if cycler.additional_outputs.is_empty() {
        return quote!(::framework::Subscriptions::new(&[]));
    }
    let subscriptions = ident(&format!("{}_subscriptions", instance.variable));
    quote!(#subscriptions.clone())
}

/// What clients may do with an instance.
fn quote_access(model: &RuntimeModel, instance: &InstanceModel) -> TokenStream {
    let cycler = &model.cyclers[instance.id.cycler];
    let InstanceModel { name, variable, .. } = instance;
    let subscriptions = if cycler.additional_outputs.is_empty() {
        quote!(::framework::Subscriptions::new(&[]))
    } else {
        let subscriptions = ident(&format!("{variable}_subscriptions"));
        quote!(#subscriptions)
    };
    let injections = ident(&format!("{variable}_injections"));
    let table = cycler.outputs.is_empty().then(|| {
        let table = database(cycler, "Injections");
        quote!(::<#table>)
    });
    let procedures = cycler.procedures.iter().map(|procedure| {
        let (text, caller) = (&procedure.name, ident(&format!("{variable}_{}", procedure.name)));
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

/// The instance that a source reads.
fn read<'a>(model: &'a RuntimeModel, source: &Source) -> &'a InstanceModel {
    let mut instances = model.runtime.instances.iter();
    instances.find(|instance| instance.id == source.id).expect("a source is an instance")
}

/// Where the parameters of one instance are.
fn instance_path(base: &str, prefix: &[String], instance: &InstanceModel) -> Vec<String> {
    let own = snake_case(&instance.name);
    base.split('.').map(str::to_owned).chain(prefix.iter().cloned()).chain([own]).collect()
}

/// A type of a cycler's database.
fn database(cycler: &CyclerModel, name: &str) -> TokenStream {
    path(&format!("crate::databases::{}::{name}", cycler.module))
}
