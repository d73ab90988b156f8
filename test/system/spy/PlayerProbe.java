import java.awt.Rectangle;
import java.awt.Robot;
import java.io.File;
import javax.imageio.ImageIO;

/**
 * Runs LCM's log player as scripts/logplayer-gui does, lets it play for some seconds, and saves what is on the
 * screen. usage: PlayerProbe URL LOG SECONDS PICTURE
 */
public class PlayerProbe {
  public static void main(String[] args) throws Exception {
    lcm.logging.LogPlayer.main(new String[] {"--lcm-url=" + args[0], args[1]});
    Thread.sleep(Long.parseLong(args[2]) * 1000);
    ImageIO.write(new Robot().createScreenCapture(new Rectangle(1280, 1024)), "png", new File(args[3]));
    System.exit(0);
  }
}
