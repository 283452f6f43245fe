// Begins: connection → store → panels, in this one direction.
import { Arrangement } from "./store/layout";
import { Robots } from "./store/robots";
import "./style/base.css";
import "./style/frame.css";
import "./style/panels.css";
import "./style/robotics.css";
import "./style/time.css";
import { header } from "./view/header";
import { Sidebar } from "./view/sidebar";
import { Workspace } from "./view/workspace";

const address = new URL("socket", location.href);
address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
address.search = "";
address.hash = "";

const robots = new Robots(location.host, address.href);
const arrangement = new Arrangement();
const sidebar = new Sidebar(robots.own, arrangement);
const workspace = new Workspace(robots, arrangement);
document.body.replaceChildren(header(robots, arrangement), sidebar.element, workspace.element);
