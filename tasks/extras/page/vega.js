'use strict';

// Vega comes as CommonJS modules. This is the part of CommonJS that they need, and the part of Vega that charts use.
const vega = (() => {
  const aliases = {'vega-selections': 'vega-selection'};
  const loaded = {};
  const load = (name) => {
    const known = aliases[name] || name;
    if (!loaded[known]) {
      loaded[known] = {exports: {}};
      modules[known](loaded[known].exports, loaded[known], load);
    }
    return loaded[known].exports;
  };
  const {extend} = load('vega-util');
  extend(load('vega-dataflow').transforms, load('vega-transforms'), load('vega-view-transforms'), load('vega-encode'));
  return {View: load('vega-view').View, parse: load('vega-parser').parse, Warn: load('vega-util').Warn};
})();
