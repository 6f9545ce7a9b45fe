// Elements by their id, and made anew: make('td', {class: 'x'}, 'text', child).

export const by_id = (id) => document.getElementById(id);

export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export function fill(parent, ...children) {
  parent.replaceChildren(...children);
  return parent;
}
