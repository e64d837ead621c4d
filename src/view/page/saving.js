// Saves what is shown as a picture.
import { drawLegend, legendSize } from './legend.js';
import { element } from './ui.js';

/** Makes a PNG file of the canvas, with the legend. @param theme colours: ink, soft, back */
export function savePicture(source, legend, theme, title) {
  const canvas = element('canvas', { width: source.width, height: source.height });
  const context = canvas.getContext('2d');
  context.drawImage(source, 0, 0);
  const scale = source.width / source.clientWidth;
  if (legend) {
    context.setTransform(scale, 0, 0, scale, 20 * scale, source.height - (18 + legendSize(legend)[1]) * scale);
    drawLegend(context, legend, theme);
  }
  canvas.toBlob((blob) => {
    const name = (title || 'view').replace(/[^\p{L}\p{N}._ -]+/gu, '_');
    const link = element('a', { href: URL.createObjectURL(blob), download: `${name}.png` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
}
